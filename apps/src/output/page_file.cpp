// SPDX-License-Identifier: BSD-3-Clause
#include "output/page_file.h"

#include <stdexcept>

#include "json/json_value.h"
#include "output/child.h"
#include "output/output_file.h"
#include "output/shared_folder.h"

namespace vericone {

std::string page_with(const Json& data) {
  const std::filesystem::path file = shared_folder("viewer") / "template.html";
  std::string page = content_of(file);
  constexpr std::string_view kPlace = "@DATA@";
  const auto at = page.find(kPlace);
  if (at == std::string::npos) throw std::runtime_error("no page to fill in " + file.string());
  std::string text;
  // No name can end the element that holds the data.
  for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace))
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return page.replace(at, kPlace.size(), text);
}

void open_in_browser(const std::filesystem::path& file) {
  const ChildOutput child = run_child("xdg-open", {std::filesystem::absolute(file).string()});
  if (child.status == kNotStarted)
    throw std::runtime_error("xdg-open is not there: open " + file.string() + " in any browser");
  if (child.status != 0)
    throw std::runtime_error("xdg-open failed: open " + file.string() + " in any browser");
}

}  // namespace vericone
