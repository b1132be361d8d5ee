// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace grove::detail {

// CLI11's help layout with descriptions wrapped for terminals of 100 columns. Options without a
// description are hidden; they are for experiments, or were removed.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace grove::detail
