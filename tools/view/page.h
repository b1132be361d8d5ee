// SPDX-License-Identifier: MIT
// The pages of `grove view`: each is a single file without external resources.
#pragma once

#include <string>
#include <string_view>

namespace grove::detail {

// True if `text` is a page of this program, of any version.
bool is_page(std::string_view text);

// Page that plays plans. `data`: see page_data.h.
std::string plan_page(std::string_view title, std::string_view data);

// Page of a run. `log`: lines of JSON (run_log_file.h).
std::string run_page(std::string_view title, std::string_view log);
// Page of a run whose log grows. The page requests the log from its own server only.
std::string following_page(std::string_view title);

// Page of an execution. `data`: see page_data.h, with one plan; `order` and `drive`: see
// drive_data.h.
std::string drive_page(std::string_view title, std::string_view data, std::string_view order,
                       std::string_view drive);
// Page of an execution whose log grows. The page requests the log from its own server only.
std::string following_drive_page(std::string_view title, std::string_view data,
                                 std::string_view order);

// Page of a certificate. `data`: see page_data.h, with at most one plan; `certificate`: the lines
// of the certificate, see certificate_text.h.
std::string proof_page(std::string_view title, std::string_view data, std::string_view certificate);

}  // namespace grove::detail
