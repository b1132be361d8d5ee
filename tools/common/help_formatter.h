// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace grove::detail {

// CLI11's help with descriptions wrapped, so that an 100-column terminal shows them whole; options
// without one are for experiments, and are not shown.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace grove::detail
