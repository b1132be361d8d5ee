// SPDX-License-Identifier: MIT
// Reads the list of instances of a batch: the files of a folder, or the lines of a manifest.
#pragma once

#include <filesystem>
#include <vector>

#include "batch/entry.h"

namespace grove::detail::batch {

// Reads a folder: every *.cts.json file in it and below, by name. Or reads a manifest: one instance
// per line, in that order, as `grove generate dataset` lists them:
//
//     # a comment: from '#' at the beginning of a line
//     rooms/room_s1_n10_m30.cts.json
//     room-32-32-4-random-1.scen --map room-32-32-4.map --agents 20
//
// Paths are relative to the manifest. The id of an instance is its path relative to the folder,
// without its suffix, plus "-20" for the first 20 rows of a scenario. For an instance outside the
// folder it is the file's name and the name of the file's folder. An id does not depend on the
// other instances of the batch.
//
// Throws InputError, with the line, if a file does not exist, an instance occurs twice, two
// instances would have the same id, or there is no instance. The instances themselves are not
// checked: an invalid one is reported in its own row. `rules` apply to all entries.
std::vector<Entry> read_manifest(const std::filesystem::path& manifest_or_folder,
                                 const InputRules& rules = {});

}  // namespace grove::detail::batch
