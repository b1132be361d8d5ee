// SPDX-License-Identifier: MIT
// The pages of `grove view`: each one file that needs nothing beside it.
#pragma once

#include <string>
#include <string_view>

namespace grove::detail {

// Plays plans. `data`: of page_data.h.
std::string plan_page(std::string_view title, std::string_view data);

// Shows what a run did. `log`: lines of JSON (run_log_file.h).
std::string run_page(std::string_view title, std::string_view log);
// The same of a log that grows, which it asks the server that it came from for, and no one else.
std::string following_page(std::string_view title);

// Shows a drive. `data`: of page_data.h, with one plan; `order` and `drive`: of drive_data.h.
std::string drive_page(std::string_view title, std::string_view data, std::string_view order,
                       std::string_view drive);
// The same of a drive whose log grows.
std::string following_drive_page(std::string_view title, std::string_view data,
                                 std::string_view order);

// Shows a certificate. `data`: of page_data.h, with one plan at most; `certificate`: its lines, of
// certificate_text.h.
std::string proof_page(std::string_view title, std::string_view data, std::string_view certificate);

}  // namespace grove::detail
