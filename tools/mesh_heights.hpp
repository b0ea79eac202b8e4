/* SPDX-License-Identifier: MIT */
/*
 * mesh_heights - a grid of heights (a grey PNG or rows of numbers) as a soup of triangles. The first row is farthest north (+y), the
 * first column farthest west (-x), and the middle of the grid at x = y = 0. Each square is cut from its south-west to its north-east
 * corner.
 */
#ifndef CAROM_TOOLS_MESH_HEIGHTS_HPP
#define CAROM_TOOLS_MESH_HEIGHTS_HPP

#include <cctype>
#include <charconv>
#include <fstream>

#include "mesh_options.hpp"
#include "mesh_png.hpp"
#include "mesh_read.hpp"

namespace mend
{

constexpr double white_height = 10; /* units, unless --height sets another */

/* ----------------------------------------------------------------------- text */

/* The contents of a file, for a message. */
inline std::string shown(const std::string &cell)
{
    std::string text = cell.substr(0, 20);

    for (char &c : text) {
        c = std::isprint(static_cast<unsigned char>(c)) ? c : '?';
    }
    return "'" + text + (cell.size() > 20 ? "...'" : "'");
}

inline std::string trimmed(const std::string &text)
{
    const size_t from = text.find_first_not_of(" \t\r"), to = text.find_last_not_of(" \t\r");

    return from == std::string::npos ? "" : text.substr(from, to - from + 1);
}

/* Columns are separated by semicolons if the line has one, otherwise by commas, otherwise by blanks. */
inline std::vector<std::string> cells_of(const std::string &line)
{
    const size_t mark = line.find(';') != std::string::npos ? line.find(';') : line.find(',');
    const std::string separators = mark == std::string::npos ? " \t" : line.substr(mark, 1);
    std::vector<std::string> cells;
    size_t from = 0;

    while (from <= line.size()) {
        const size_t to = std::min(line.find_first_of(separators, from), line.size());
        const std::string cell = trimmed(line.substr(from, to - from));

        if (!cell.empty() || mark != std::string::npos) {
            cells.push_back(cell);
        }
        from = to + 1;
    }
    return cells;
}

inline double height_from(const std::string &cell, const std::string &where)
{
    const char *begin = cell.data() + (cell.size() > 1 && cell[0] == '+'),
               *end = cell.data() + cell.size();
    double number = 0;
    const auto [stopped, error] = std::from_chars(begin, end, number);

    if (cell.empty()) {
        throw Refusal(where + " is empty: a grid has a number at each place");
    }
    if (stopped != end || error == std::errc::invalid_argument) {
        throw Refusal(where + " is not a number: " + shown(cell) +
                      (cell.find(',') != std::string::npos ? "; write 1.5, not 1,5" : ""));
    }
    if (error != std::errc() || !std::isfinite(number)) {
        throw Refusal(where + " is not a finite number: " + shown(cell));
    }
    return number;
}

inline Grid read_rows_of_numbers(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::string line;
    Grid grid;

    for (size_t number = 1; std::getline(file, line); number++) {
        if (number == 1 && line.compare(0, 3, "\xef\xbb\xbf") == 0) {
            line.erase(0, 3); /* the byte order mark that some editors put before UTF-8 */
        }
        const std::vector<std::string> cells = cells_of(trimmed(line));

        if (trimmed(line).empty()) {
            continue;
        }
        for (size_t i = 0; i < cells.size(); i++) {
            grid.samples.push_back(
                height_from(cells[i], format("line %zu, column %zu", number, i + 1)));
        }
        grid.columns = grid.columns ? grid.columns : cells.size();
        if (cells.size() != grid.columns) {
            throw Refusal(
                format("line %zu has %s, the first one %zu: all rows of a grid are equally long",
                       number, counted(cells.size(), "number").c_str(), grid.columns));
        }
        if (grid.samples.size() > samples_max) {
            throw Refusal(format("more than %zu numbers are too many to read", samples_max));
        }
    }
    if (grid.samples.empty()) {
        throw Refusal("holds no numbers: a grid has rows of them, apart by , ; or blanks");
    }
    return grid;
}

/* ----------------------------------------------------------------------- grid */

inline size_t thinned(size_t count, size_t every)
{
    return (count - 1) / every + 1;
}

/* True if a grid of so many samples is within the limits of a mesh. */
inline bool few_enough(size_t columns, size_t rows)
{
    return columns * rows <= count_max && 2 * (columns - 1) * (rows - 1) <= count_max;
}

inline void check_grid(const Grid &grid, size_t every, double cell)
{
    const size_t columns = thinned(grid.columns, every), rows = thinned(grid.rows(), every);
    const size_t longer = std::max(columns, rows) - 1;
    size_t enough = every;

    if (columns < 2 || rows < 2) {
        throw Refusal(format("a grid of %zu x %zu samples has no face: at least 2 x 2 are needed%s",
                             columns, rows, every > 1 ? "; --every leaves too few" : ""));
    }
    while (!few_enough(thinned(grid.columns, enough), thinned(grid.rows(), enough))) {
        enough++;
    }
    if (enough > every) {
        throw Refusal(format("%zu x %zu samples make %zu vertices and %zu faces: at most %zu of "
                             "each are possible; --every %zu takes few enough",
                             columns, rows, columns * rows, 2 * (columns - 1) * (rows - 1),
                             count_max, enough));
    }
    if (double(longer) * double(every) * cell > side_max) {
        throw Refusal(format("a side of %.10g units is too long: at most %.10g are possible; "
                             "--cell %.6g fits",
                             double(longer * every) * cell, side_max,
                             std::floor(side_max / double(longer * every) * 1e5) / 1e5));
    }
}

inline Grid read_grid(const std::string &path)
{
    static const std::string mark = "\x89PNG";
    std::string head(4, '\0');

    check_readable(path);
    std::ifstream(path, std::ios::binary).read(&head[0], 4);
    return head == mark ? png::read_grey(path) : read_rows_of_numbers(path);
}

/* Samples as corners, from the north-west, row by row. */
inline void put_corners(Soup &soup, const Grid &grid, const Heights &how, double scale)
{
    const size_t columns = thinned(grid.columns, how.every), rows = thinned(grid.rows(), how.every);
    const double step = how.cell * double(how.every);
    const double factor = grid.most > 0 ? (how.height_said ? how.height : white_height) / grid.most
                                        : (how.height_said ? how.height : 1);

    for (size_t r = 0; r < rows; r++) {
        for (size_t c = 0; c < columns; c++) {
            const double sample = grid.samples[(r * grid.columns + c) * how.every];

            soup.points.push_back({(double(c) - double(columns - 1) / 2) * step * scale,
                                   (double(rows - 1) / 2 - double(r)) * step * scale,
                                   (sample * factor + how.offset) * scale});
        }
    }
    for (uint32_t r = 0; r + 1 < rows; r++) {
        for (uint32_t c = 0; c + 1 < columns; c++) {
            const uint32_t north = r * uint32_t(columns) + c, south = north + uint32_t(columns);

            soup.faces.push_back({south, south + 1, north + 1});
            soup.faces.push_back({south, north + 1, north});
        }
    }
    soup.polygons = soup.faces.size() / 2;
}

inline std::string told(const Grid &grid, const Heights &how)
{
    const size_t columns = thinned(grid.columns, how.every), rows = thinned(grid.rows(), how.every);
    const double height = how.height_said ? how.height : grid.most > 0 ? white_height : 1;
    std::string text =
        format("%zu x %zu samples, %.10g units apart; ", columns, rows,
               how.cell * double(how.every)) +
        format(grid.most > 0 ? "white is %.10g units above black" : "a height of 1 is %.10g units",
               height);
    const size_t right = (grid.columns - 1) % how.every, below = (grid.rows() - 1) % how.every;

    return right + below == 0
               ? text
               : text +
                     format("; --every left out the last %zu columns and %zu rows", right, below);
}

/* scale: the factor of all three axes, after --cell and --height. */
inline Soup read_heights(const std::string &path, const Heights &how, double scale)
{
    const Grid grid = read_grid(path);
    Soup soup;

    check_grid(grid, how.every, how.cell * scale);
    put_corners(soup, grid, how, scale);
    soup.objects = {"heights"};
    soup.doubt = told(grid, how);
    return soup;
}

} // namespace mend

#endif
