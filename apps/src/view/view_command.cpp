// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>
#include <filesystem>
#include <iostream>
#include <string>

#include "commands.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "output/page_file.h"
#include "view/scene_page.h"
#ifdef VERICONE_WITH_SIMULATION
#include "simulate/run_page.h"
#endif

namespace vericone {
namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  std::string what, out = "out/view.html";
  bool open = false, json = false;
};

/// Of a scene, or of a folder that a command has written.
Json page_data(const std::string& what) {
  if (fs::is_directory(what)) {
#ifdef VERICONE_WITH_SIMULATION
    return run_page(what, scenario_of_run(what));
#else
    throw InputError("what", what, "a scene: this build has no runs");
#endif
  }
  const std::string title = what == "-" ? "standard input" : fs::path(what).filename().string();
  return scene_page(scenes::read_scene(what), title);
}

/// `vericone view`: a page that shows a scene or a run and answers about it. Returns the exit status.
int run_view(const ViewOptions& options, std::ostream& out) {
  const fs::path file = options.out;
  if (!file.has_filename() || fs::is_directory(file))
    throw InputError("--out", options.out, "the name of a file for the page");
  const fs::path folder = file.parent_path();
  work::StagedFolder stage(folder.empty() ? "." : folder, "--out");
  const std::string page = page_with(page_data(options.what));
  write_whole(stage.path() / file.filename(), page);
  stage.publish();
  if (options.json)
    out << Json{{"page", options.out}, {"bytes", page.size()}}.dump() << '\n';
  else
    out << "page                " << options.out << ", " << (page.size() + 500) / 1000 << " kB\n";
  if (options.open) open_in_browser(file);
  return 0;
}

}  // namespace

int view_command(CommandLine& line) {
  ViewOptions view;
  line.option("what", view.what,
              "Scene file, YAML (docs/reference/formats.md), - for standard input; or a folder that simulate "
              "has written")
      .required();
  line.option("--out", view.out, "File for the page");
  line.flag("--open", view.open, "Show it in the browser (xdg-open)");
  line.flag("--json", view.json, "Print JSON");
  line.quiet();
  line.read();
  return run_view(view, std::cout);
}

}  // namespace vericone
