// Meshers from outside: a JSON file names a command line, and the mesher appears in the tables like any
// other.
//
// {"name": "mytool",                                    letters, digits, hyphens; known as external:mytool
//  "description": "what it is",                         one line
//  "licence": "MIT",                                    SPDX expression
//  "command": ["mytool", "{image}", "{mesh}", "-j", "{threads}", "--size={size}"],
//  "image": "nii.gz",                                   optional: nii, nii.gz, nrrd or mha, see below
//  "output": "vtu",                                     vtu, vtk or msh, with an integer cell array `label`
//  "probe": ["./here.py", "mytool"],                    optional, see below
//  "version_command": ["mytool", "--version"],          optional; its first line goes into the provenance
//  "multithreaded": true, "deterministic": true,        optional; default: false, true
//  "parameters": [{"key": "size", "default": "2", "unit": "mm", "description": "element size"}],    optional
//  "size_dial": {"parameter": "size", "exponent": -3, "first": 2, "lowest": 0.01, "highest": 100}} optional:
//                                       elements ~ size^exponent, and the values from which and between which
//                                       runs with budgets of elements seek it
//
// No shell sees the command: each entry is one argument, whatever it holds. Braces name a value: {image},
// {mesh} and {report} are files, {threads} a number, all others must be parameters; "{{" stands for "{". A
// program with a slash is meant relative to the JSON file's folder, any other is sought in PATH. A mesher
// that writes to {report} the JSON of driver.hpp is timed by its own figures, any other from its start to its
// end. {image} is the case's own file unless "image" asks for a format, into which it is then converted.
// "probe" is a command that succeeds where the mesher can run; the first line that it prints else is the
// reason in the tables.
#pragma once

#include <filesystem>

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

/// Reads a mesher from its JSON file. Throws InputError naming file, key and remedy.
Adapter load_external_mesher(const std::filesystem::path& file);

}  // namespace cbc3d::baselines
