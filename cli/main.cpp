// The tool: `sweepface COMMAND ...`. Each command has a file of its own.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <iostream>

#include "command.hpp"
#include "output.hpp"

#ifdef _WIN32
#include "windows/console.hpp"
#endif
#ifdef __GLIBC__
#include <limits>
#include <malloc.h>
#endif
#ifdef __wasi__
#include <cstdlib>
#include <tuple>
#include <unistd.h>
#endif

namespace sweepface::cli {
namespace {

constexpr int kFailed = 1, kMisused = 2;
constexpr const char* kReportIsLost = "Cannot write the report: the output is full or closed.";

/// What was misused and where to find help; `app` is the whole tool.
std::string usageMessage(const CLI::App* app, const CLI::Error& error) {
  const std::vector<const CLI::App*> commands = app->get_subcommands({});
  const auto used = std::ranges::find_if(commands, [](const CLI::App* c) { return c->parsed(); });
  const std::vector<std::string> unknown = app->remaining();
  std::string sentence = error.what();
  std::string help = "sweepface";
  if (used != commands.end())
    help += " " + (*used)->get_name();
  else
    sentence = unknown.empty() ? "A command is required."
                               : fmt::format("There is no command '{}'.", unknown.front());
  return fmt::format("sweepface: {}\nTry `{} --help`.\n", sentence, help);
}

int run(int argc, char** argv) {
  CLI::App tool(
      "Turns a face mesh and its expressions into a network of smooth surfaces with a "
      "guaranteed error,\nand moves it by Newton's second law.",
      "sweepface");
  tool.allow_windows_style_options(false);  // a path may begin with a slash there, too
  tool.formatter(std::make_shared<HelpFormatter>());
  tool.set_version_flag("--version", "sweepface " SWEEPFACE_VERSION, "Print the version and exit");
  tool.require_subcommand(1);
  tool.failure_message(usageMessage);
  tool.footer(
      "\nStart with:\n  sweepface convert neutral.obj expressions/ -o face.sweep\n"
      "  sweepface COMMAND --help tells more about a command.");
  std::vector<Command> commands;
  for (auto add : {addConvert, addInfo, addCheck, addMeasure, addExport, addAnimate, addWireframe,
                   addRender, addReport, addPlot, addLaws, addBuild, addEdit, addPack})
    commands.push_back(add(tool));

  // `help COMMAND`, as in other tools.
  std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    words.resize(std::min<std::size_t>(words.size(), 1));
    const auto isKnown = [&](const Command& c) { return c.app->get_name() == words.front(); };
    if (words.empty() || std::ranges::any_of(commands, isKnown)) words.emplace_back("--help");
  }
  std::ranges::reverse(words);  // CLI11 takes them in this order
  try {
    tool.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    if (tool.exit(error) != 0) return kMisused;
    if (std::cout.flush()) return 0;
    printError(kReportIsLost);
    return kFailed;
  }
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    const Result<int> code = command.run();
    if (code && std::fflush(stdout) == 0 && !std::ferror(stdout)) return *code;
    printError(code ? kReportIsLost : code.error().message);
    return kFailed;
  }
  return kMisused;
}

}  // namespace
}  // namespace sweepface::cli

int main(int argc, char** argv) {
#ifdef _WIN32
  const sweepface::cli::Console console;
#endif
#ifdef __GLIBC__
  // Fitting needs the same large matrices again and again. Where they are given back in between,
  // clearing their pages takes up to a seventh of the time.
  mallopt(M_MMAP_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
#ifdef __wasi__
  // A module is always started in the root folder.
  if (const char* const folder = std::getenv("PWD")) std::ignore = ::chdir(folder);
#endif
  try {
    return sweepface::cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    sweepface::cli::printError(
        "There is not enough memory for this; ask for a coarser mesh or a smaller "
        "picture, or close other programs.");
  } catch (const std::exception& error) {
    sweepface::cli::printError(std::ferror(stdout) ? sweepface::cli::kReportIsLost : error.what());
  }
  return 1;
}
