/* SPDX-License-Identifier: MIT */
/* mesh_png - reads grey pictures and writes colour pictures, by libpng. */
#ifndef CAROM_TOOLS_MESH_PNG_HPP
#define CAROM_TOOLS_MESH_PNG_HPP

#include <csetjmp>
#include <cstring>

#include <png.h>

#include "mesh_soup.hpp"

namespace mend
{

/* Rows of numbers, all of them equally long. */
struct Grid {
    size_t columns = 0;
    std::vector<double> samples;
    double most = 0; /* largest value of a sample of this kind; 0: no limit */

    size_t rows() const
    {
        return columns ? samples.size() / columns : 0;
    }
};

constexpr size_t samples_max = size_t(1) << 26; /* limit on what is read, before --every */

namespace png
{

struct Reader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::FILE *file = nullptr;
    char message[200] = "";

    explicit Reader(const std::string &path) : file(std::fopen(path.c_str(), "rb"))
    {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
        info = png ? png_create_info_struct(png) : nullptr;
        if (!file || !info) {
            throw Refusal("cannot be opened: check the path, and the memory");
        }
    }
    Reader(const Reader &) = delete;
    ~Reader()
    {
        png_destroy_read_struct(&png, &info, nullptr);
        if (file) {
            std::fclose(file);
        }
    }
    [[noreturn]] static void fail(png_structp png, png_const_charp text)
    {
        std::snprintf(static_cast<Reader *>(png_get_error_ptr(png))->message, sizeof message, "%s",
                      text);
        png_longjmp(png, 1);
    }
    static void ignore(png_structp, png_const_charp)
    {
    }
    [[noreturn]] void refuse() const
    {
        throw Refusal(std::string("the PNG is truncated or damaged: export it again\n  libpng: ") +
                      message);
    }
};

/* libpng leaves by a long jump: construct nothing with a destructor between here and there. */
inline bool read_head(Reader &reader)
{
    if (setjmp(png_jmpbuf(reader.png))) {
        return false;
    }
    png_init_io(reader.png, reader.file);
    png_read_info(reader.png, reader.info);
    return true;
}

inline bool read_rows(Reader &reader, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(reader.png))) {
        return false;
    }
    png_read_image(reader.png, rows);
    png_read_end(reader.png, nullptr);
    return true;
}

inline void check_head(const Reader &reader)
{
    const size_t width = png_get_image_width(reader.png, reader.info),
                 height = png_get_image_height(reader.png, reader.info);

    if (png_get_color_type(reader.png, reader.info) != PNG_COLOR_TYPE_GRAY) {
        throw Refusal("the PNG has colours or transparency: heights are grey; save it as grey of "
                      "8 or 16 bits, without alpha");
    }
    if (width * height > samples_max) {
        throw Refusal(format("a PNG of %zu x %zu is too large to read: at most %zu samples; shrink "
                             "it in an editor of pictures",
                             width, height, samples_max));
    }
}

/* The numbers of the file, without gamma correction. */
inline Grid read_grey(const std::string &path)
{
    Reader reader(path);
    Grid grid;

    if (!read_head(reader)) {
        reader.refuse();
    }
    check_head(reader);
    png_set_expand_gray_1_2_4_to_8(reader.png);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);

    const size_t row_bytes = png_get_rowbytes(reader.png, reader.info);
    const bool wide = png_get_bit_depth(reader.png, reader.info) == 16;
    const size_t height = png_get_image_height(reader.png, reader.info);
    std::vector<png_byte> bytes(row_bytes * height);
    std::vector<png_bytep> rows;

    for (size_t y = 0; y < height; y++) {
        rows.push_back(&bytes[y * row_bytes]);
    }
    if (!read_rows(reader, rows.data())) {
        reader.refuse();
    }
    grid.columns = png_get_image_width(reader.png, reader.info);
    grid.most = wide ? 65535 : 255;
    for (size_t i = 0; i < bytes.size(); i += wide ? 2 : 1) {
        grid.samples.push_back(wide ? bytes[i] * 256 + bytes[i + 1] : bytes[i]);
    }
    return grid;
}

/* Write a file of 8-bit red, green and blue. */
inline std::string written(const std::vector<uint8_t> &rgb, uint32_t width, uint32_t height)
{
    png_image image;
    png_alloc_size_t size = 0;
    std::string file;

    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_memory(&image, nullptr, &size, 0, rgb.data(), 0, nullptr)) {
        file.resize(size);
        if (png_image_write_to_memory(&image, &file[0], &size, 0, rgb.data(), 0, nullptr)) {
            return file;
        }
    }
    throw Refusal(std::string("the picture cannot be made: ") + image.message);
}

} // namespace png

} // namespace mend

#endif
