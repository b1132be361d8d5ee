// SPDX-License-Identifier: MIT
// What a batch consists of: the files of a folder, or the lines of a manifest.
#pragma once

#include <filesystem>
#include <vector>

#include "batch/entry.h"

namespace grove::detail::batch {

// A folder: every *.cts.json file in it and below, by name. A file: one instance a line, in that
// order, as `grove generate dataset` lists them:
//
//     # a comment: from '#' at the beginning of a line
//     rooms/room_s1_n10_m30.cts.json
//     room-32-32-4-random-1.scen --map room-32-32-4.map --agents 20
//
// Paths are relative to the manifest. An id is the path without its suffix, as seen from the
// folder, plus "-20" for the first 20 rows of a scenario; of an instance that does not lie in the
// folder or below it, the file's name and that of the folder it is in. It does not depend on what
// else the batch holds.
//
// Throws InputError, with the line, when there is no such file, when an instance occurs twice or
// two would have one id, and when there is no instance at all. Does not look into the instances: a
// broken one is a matter of its own row. `rules` are those of all entries.
std::vector<Entry> read_manifest(const std::filesystem::path& manifest_or_folder,
                                 const InputRules& rules = {});

}  // namespace grove::detail::batch
