/* SPDX-License-Identifier: MIT */
/* mesh_options - the command line of carom-mesh. */
#ifndef CAROM_TOOLS_MESH_OPTIONS_HPP
#define CAROM_TOOLS_MESH_OPTIONS_HPP

#include <cctype>
#include <cstdlib>
#include <filesystem>

#include <getopt.h>

#include "mesh_soup.hpp"

namespace mend
{

/* The conversion of a grid to a surface. */
struct Heights {
    double cell = 1; /* units from one sample to the next */
    double height = 0, offset = 0;
    bool height_said = false;
    size_t every = 1; /* take every n-th sample, along both sides */
};

struct Options {
    std::string in, out_c, out_blob, out_picture, name, object, shape;
    bool surface = false, check_only = false, indexed = false;
    bool grid = false, objects = false;
    Heights heights;
    bool heights_said = false; /* an option was given that needs --heights */
    int bits = 0;              /* 0: chosen by the converter */
    double scale = 1;
    Repairs repairs;
    bool y_up = false, unit_said = false, millimetres = false;
};

inline const char usage[] =
    "usage: carom-mesh [options] FILE       (obj, stl, ply, gltf, glb and what else assimp reads)\n"
    "       carom-mesh [options] --heights FILE       (a grey PNG, or rows of numbers: CSV)\n"
    "       carom-mesh [options] --shape SHAPE\n"
    "  -o, --output FILE.c     write a C source\n"
    "  -b, --blob FILE.crm     write a binary blob\n"
    "      --index             the C source has the mesh indexed, for ROM: a struct carom_mesh\n"
    "      --preview FILE.png  a picture of the mesh, from two sides\n"
    "      --check             write nothing\n"
    "      --surface           a height field, open, z up; otherwise a closed solid\n"
    "      --name NAME         of the mesh in the C source; otherwise the file's\n"
    "      --quantum-bits N    coordinates in steps of 2^-N units, N from 7 to 20\n"
    "      --scale F           multiply coordinates by F first\n"
    "      --unit mm|m         what a coordinate of the file counts; a unit of Carom is a metre\n"
    "      --object NAME       only the object of this name, with all below it; otherwise all, "
    "joined\n"
    "      --objects           each object as a mesh of its own, named after it: FILE.c has them "
    "all,\n"
    "                          FILE.crm and FILE.png become FILE.OBJECT.crm and FILE.OBJECT.png\n"
    "      --up y|z            which axis of the file is up; otherwise z\n"
    "      --close             fill the holes that are flat\n"
    "      --simplify N        bring the mesh down to at most N faces\n"
    "      --overlaps allow    take parts that overlap, though what both hold counts twice; or "
    "refuse\n"
    "      --heights           FILE is a grid of heights, its first row in the north (+y):\n"
    "      --cell F              units from one sample to the next; otherwise 1\n"
    "      --height F            units from black to white, otherwise 10; of a CSV, units for a 1\n"
    "      --offset F            units that all heights are raised by\n"
    "      --every N             take every Nth sample along both sides\n"
    "      --shape SHAPE       box:X,Y,Z  sphere:RADIUS,SIDES  capsule:RADIUS,LENGTH,SIDES\n"
    "                          cylinder:RADIUS,HEIGHT,SIDES  cone:RADIUS,HEIGHT,SIDES, in units;\n"
    "                          a capsule's LENGTH is the part between its hemispheres\n";

inline bool is_keyword(const std::string &name)
{
    static const std::set<std::string> keywords = {
        "auto",    "break",  "case",     "char",   "const",    "continue", "default",
        "do",      "double", "else",     "enum",   "extern",   "float",    "for",
        "goto",    "if",     "inline",   "int",    "long",     "register", "restrict",
        "return",  "short",  "signed",   "sizeof", "static",   "struct",   "switch",
        "typedef", "union",  "unsigned", "void",   "volatile", "while"};

    return keywords.count(name) > 0;
}

/* An identifier of C from any text. */
inline std::string identifier_from(std::string name)
{
    for (char &c : name) {
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    }
    return name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) || is_keyword(name)
               ? "mesh_" + name
               : name;
}

inline bool is_identifier(const std::string &name)
{
    return !name.empty() && !is_keyword(name) &&
           !std::isdigit(static_cast<unsigned char>(name[0])) &&
           std::all_of(name.begin(), name.end(),
                       [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

inline double number_from(const char *option, const char *text)
{
    char *end;
    const double number = std::strtod(text, &end);

    if (*text == '\0' || *end != '\0' || !std::isfinite(number)) {
        throw Refusal(std::string(option) + ": not a number: " + text);
    }
    return number;
}

inline double number_above_0(const char *option, const char *text)
{
    const double number = number_from(option, text);

    if (number <= 0) {
        throw Refusal(std::string(option) + ": must be above 0");
    }
    return number;
}

inline int whole_number(const char *option, const char *text, int least, int most)
{
    const double number = number_from(option, text);

    if (number < least || number > most || number != std::floor(number)) {
        throw Refusal(
            format("%s: a whole number from %d to %d, not %s", option, least, most, text));
    }
    return int(number);
}

/* True for the first of two words, false for the second; another word is an error. */
inline bool is_first(const char *option, const std::string &text, const std::string &first,
                     const std::string &second)
{
    if (text != first && text != second) {
        throw Refusal(std::string(option) + ": " + first + " or " + second + ", not " + text);
    }
    return text == first;
}

/* The options of a grid of heights. */
inline void take_heights(Options &options, int letter, const char *text)
{
    Heights &how = options.heights;

    options.heights_said = true;
    if (letter == 'C') {
        how.cell = number_above_0("--cell", text);
    } else if (letter == 'Z') {
        how.height = number_from("--height", text);
        how.height_said = true;
    } else if (letter == 'O') {
        how.offset = number_from("--offset", text);
    } else {
        how.every = size_t(whole_number("--every", text, 1, 1000000));
    }
}

inline void take_text(Options &options, int letter, const char *text)
{
    switch (letter) {
    case 'o':
        options.out_c = text;
        break;
    case 'b':
        options.out_blob = text;
        break;
    case 'p':
        options.out_picture = text;
        break;
    case 'n':
        options.name = text;
        break;
    case 'j':
        options.object = text;
        break;
    case 'S':
        options.shape = text;
        break;
    case 'q':
        options.bits = whole_number("--quantum-bits", text, bits_min, bits_max);
        break;
    case 'f':
        options.scale = number_above_0("--scale", text);
        break;
    case 'm':
        options.unit_said = true;
        options.millimetres = is_first("--unit", text, "mm", "m");
        break;
    case 'N':
        options.repairs.most_faces = size_t(whole_number("--simplify", text, 4, count_max));
        break;
    case 'V':
        options.repairs.overlaps = is_first("--overlaps", text, "allow", "refuse");
        break;
    case 'u':
        options.y_up = is_first("--up", text, "y", "z");
        break;
    default:
        take_heights(options, letter, text);
    }
}

inline void take(Options &options, int letter, const char *text)
{
    switch (letter) {
    case 'i':
        options.indexed = true;
        break;
    case 'c':
        options.check_only = true;
        break;
    case 's':
        options.surface = true;
        break;
    case 'H':
        options.grid = options.surface = true;
        break;
    case 'J':
        options.objects = true;
        break;
    case 'F':
        options.repairs.close = true;
        break;
    case 'h':
        std::fputs(usage, stdout);
        std::exit(0);
    case '?':
        std::fputs(usage, stderr);
        std::exit(2);
    default:
        take_text(options, letter, text);
    }
}

/* Refuse options that contradict each other. */
inline void check_together(const Options &options)
{
    const bool from_file = !options.grid && options.shape.empty();

    if (options.grid && !options.shape.empty()) {
        throw Refusal("--heights and --shape: one or the other");
    }
    if (options.heights_said && !options.grid) {
        throw Refusal("--cell, --height, --offset and --every go with --heights");
    }
    if (!from_file && (options.objects || !options.object.empty() || options.y_up)) {
        throw Refusal("--object, --objects and --up y go with a mesh file");
    }
    if (!options.shape.empty() && options.surface) {
        throw Refusal("--surface: a shape is a closed solid");
    }
    if (options.objects && (!options.object.empty() || !options.name.empty())) {
        throw Refusal(
            "--objects takes each object, under its own name: not with --object or --name");
    }
}

inline Options parse(int argc, char **argv)
{
    static const option long_options[] = {
        {"output", required_argument, nullptr, 'o'},
        {"blob", required_argument, nullptr, 'b'},
        {"preview", required_argument, nullptr, 'p'},
        {"index", no_argument, nullptr, 'i'},
        {"check", no_argument, nullptr, 'c'},
        {"surface", no_argument, nullptr, 's'},
        {"name", required_argument, nullptr, 'n'},
        {"quantum-bits", required_argument, nullptr, 'q'},
        {"scale", required_argument, nullptr, 'f'},
        {"unit", required_argument, nullptr, 'm'},
        {"object", required_argument, nullptr, 'j'},
        {"objects", no_argument, nullptr, 'J'},
        {"up", required_argument, nullptr, 'u'},
        {"close", no_argument, nullptr, 'F'},
        {"simplify", required_argument, nullptr, 'N'},
        {"overlaps", required_argument, nullptr, 'V'},
        {"heights", no_argument, nullptr, 'H'},
        {"cell", required_argument, nullptr, 'C'},
        {"height", required_argument, nullptr, 'Z'},
        {"offset", required_argument, nullptr, 'O'},
        {"every", required_argument, nullptr, 'E'},
        {"shape", required_argument, nullptr, 'S'},
        {"help", no_argument, nullptr, 'h'},
        {nullptr, 0, nullptr, 0},
    };
    Options options;
    int letter;

    while ((letter = getopt_long(argc, argv, "o:b:h", long_options, nullptr)) != -1) {
        take(options, letter, optarg);
    }
    if (optind != argc - (options.shape.empty() ? 1 : 0)) {
        take(options, '?', nullptr);
    }
    options.in = options.shape.empty() ? argv[optind] : options.shape;
    check_together(options);
    if (options.name.empty()) {
        options.name = identifier_from(options.shape.empty()
                                           ? std::filesystem::path(options.in).stem().string()
                                           : options.shape.substr(0, options.shape.find(':')));
    } else if (!is_identifier(options.name)) {
        throw Refusal("--name: not an identifier of C: " + options.name);
    }
    return options;
}

} // namespace mend

#endif
