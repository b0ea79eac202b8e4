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

struct Options {
    std::string in, out_c, out_blob, name, object;
    bool surface = false, check_only = false, indexed = false;
    int bits = 0; /* 0: choose */
    double scale = 1;
    bool y_up = false, unit_said = false, millimetres = false;
};

inline const char usage[] =
    "usage: carom-mesh [options] FILE       (obj, stl, ply, gltf, glb and what else assimp reads)\n"
    "  -o, --output FILE.c     write a C source\n"
    "  -b, --blob FILE.crm     write a binary blob\n"
    "      --index             the C source has the mesh indexed, for ROM: a struct carom_mesh\n"
    "      --check             write nothing\n"
    "      --surface           a height field, open, z up; otherwise a closed solid\n"
    "      --name NAME         of the mesh in the C source; otherwise the file's\n"
    "      --quantum-bits N    coordinates in steps of 2^-N units, N from 7 to 20\n"
    "      --scale F           multiply coordinates by F first\n"
    "      --unit mm|m         what a coordinate of the file counts; a unit of Carom is a metre\n"
    "      --object NAME       only the object of this name, with all below it; otherwise all, "
    "joined\n"
    "      --up y|z            which axis of the file is up; otherwise z\n";

/* An identifier of C from a file's name. */
inline std::string name_from(const std::string &path)
{
    std::string name = std::filesystem::path(path).stem().string();

    for (char &c : name) {
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    }
    return name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) ? "mesh_" + name
                                                                             : name;
}

inline bool is_identifier(const std::string &name)
{
    return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
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

inline Options parse(int argc, char **argv)
{
    static const option long_options[] = {
        {"output", required_argument, nullptr, 'o'},
        {"blob", required_argument, nullptr, 'b'},
        {"index", no_argument, nullptr, 'i'},
        {"check", no_argument, nullptr, 'c'},
        {"surface", no_argument, nullptr, 's'},
        {"name", required_argument, nullptr, 'n'},
        {"quantum-bits", required_argument, nullptr, 'q'},
        {"scale", required_argument, nullptr, 'f'},
        {"unit", required_argument, nullptr, 'm'},
        {"object", required_argument, nullptr, 'j'},
        {"up", required_argument, nullptr, 'u'},
        {"help", no_argument, nullptr, 'h'},
        {nullptr, 0, nullptr, 0},
    };
    Options options;
    int letter;

    while ((letter = getopt_long(argc, argv, "o:b:h", long_options, nullptr)) != -1) {
        switch (letter) {
        case 'o':
            options.out_c = optarg;
            break;
        case 'b':
            options.out_blob = optarg;
            break;
        case 'i':
            options.indexed = true;
            break;
        case 'c':
            options.check_only = true;
            break;
        case 's':
            options.surface = true;
            break;
        case 'n':
            options.name = optarg;
            break;
        case 'q': {
            const double bits = number_from("--quantum-bits", optarg);

            if (bits < bits_min || bits > bits_max || bits != std::floor(bits)) {
                throw Refusal("--quantum-bits: a whole number from 7 to 20, not " +
                              std::string(optarg));
            }
            options.bits = int(bits);
            break;
        }
        case 'f':
            options.scale = number_from("--scale", optarg);
            if (options.scale <= 0) {
                throw Refusal("--scale: must be above 0");
            }
            break;
        case 'm':
            if (std::string(optarg) != "mm" && std::string(optarg) != "m") {
                throw Refusal("--unit: mm or m, not " + std::string(optarg));
            }
            options.unit_said = true;
            options.millimetres = std::string(optarg) == "mm";
            break;
        case 'j':
            options.object = optarg;
            break;
        case 'u':
            if (std::string(optarg) != "y" && std::string(optarg) != "z") {
                throw Refusal("--up: y or z, not " + std::string(optarg));
            }
            options.y_up = std::string(optarg) == "y";
            break;
        case 'h':
            std::fputs(usage, stdout);
            std::exit(0);
        default:
            std::fputs(usage, stderr);
            std::exit(2);
        }
    }
    if (optind != argc - 1) {
        std::fputs(usage, stderr);
        std::exit(2);
    }
    options.in = argv[optind];
    if (options.name.empty()) {
        options.name = name_from(options.in);
    } else if (!is_identifier(options.name)) {
        throw Refusal("--name: not an identifier of C: " + options.name);
    }
    return options;
}

} // namespace mend

#endif
