// SPDX-License-Identifier: MIT
// Reads the list of instances of a batch from a folder or a manifest.
#pragma once

#include <filesystem>
#include <vector>

#include "batch/entry.h"

namespace grove::detail::batch {

// Reads the instances of a folder (every *.cts.json file in it or below, in order of name), of a
// single FILE.cts.json, or of a manifest. A manifest has one instance per line, as `grove generate
// dataset` lists them, and the result is in that order:
//
//     # a comment: from '#' at the beginning of a line
//     rooms/room_s1_n10_m30.cts.json
//     room-32-32-4-random-1.scen --map room-32-32-4.map --agents 20
//
// Paths are relative to the manifest. The id of an instance is its path relative to the folder,
// without the suffix, plus "-20" for the first 20 rows of a scenario. For an instance outside the
// folder, the id consists of the file's name and the name of the file's folder. An id does not
// depend on the other instances of the batch.
//
// Throws InputError, with the line of a manifest, if a line is malformed, a file does not exist, an
// instance occurs twice, an id is unsuitable as a file name or not unique, or there is no instance.
// The instances themselves are not checked: an invalid instance is reported in its own row. `rules`
// apply to all entries.
std::vector<Entry> read_manifest(const std::filesystem::path& manifest_or_folder,
                                 const InputRules& rules = {});

}  // namespace grove::detail::batch
