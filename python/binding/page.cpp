// SPDX-License-Identifier: MIT
// Bindings for the pages and pictures of `grove view`.
#include "tools/view/page.h"

#include <vector>

#include "api/access.h"
#include "io/atomic_file.h"
#include "python/binding/values.h"
#include "tools/view/page_data.h"
#include "tools/view/picture/picture.h"

namespace grove::python {
namespace {

// Returns the HTML page that shows an instance and at most two solutions, each with its name.
std::string page(const Instance& instance, const std::string& title,
                 const std::vector<std::pair<std::string, SolutionOfInstance>>& solutions) {
  return with_public_exceptions([&] {
    const detail::Instance& inner = Access::instance(instance);
    std::vector<detail::NamedPlan> plans;
    for (const auto& [name, solution] : solutions)
      plans.push_back({name, {.solution = solution_of(inner, solution.whole()), .unclaimed = {}}});
    return detail::plan_page(title, detail::page_data(title, inner, plans));
  });
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
  with_public_exceptions([&] { detail::write_file_atomically(path, bytes); });
}

py::bytes picture(const Instance& instance, const std::optional<PlanOfInstance>& plan,
                  const std::string& kind, const std::vector<double>& moments, int width,
                  double speed) {
  return with_public_exceptions([&]() -> std::string {
    const detail::Instance& inner = Access::instance(instance);
    std::optional<detail::Plan> own;
    if (plan) own = plan_of(inner, *plan->plan);
    const detail::Drawing drawing(inner, own ? &*own : nullptr);
    if (kind == "gif") return detail::gif_picture(drawing, width, speed);
    return kind == "png" ? detail::png_picture(drawing, moments, width)
                         : detail::svg_picture(drawing, moments, width);
  });
}

}  // namespace

void add_page(py::module_& module) {
  module.def("_page", &page);
  module.def("_write_file", [](const std::filesystem::path& path, const py::bytes& bytes) {
    write_file(path, bytes);
  });
  module.def("_picture", &picture);
}

}  // namespace grove::python
