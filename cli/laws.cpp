#include "sweepface/laws.hpp"

#include <fmt/format.h>

#include "sweepface/io.hpp"

#include "command.hpp"
#include "output.hpp"

namespace sweepface::cli {
namespace {

struct LawsArguments {
  std::string output;
  bool quiet = false;
};

void addOptions(CLI::App& app, LawsArguments& a) {
  addOutput(app, a.output, "The .svg file to write");
  addQuiet(app, a.quiet);
  app.footer("\nExample:\n  sweepface laws -o laws.svg    # opens in any browser");
}

Result<int> runLaws(const LawsArguments& a) {
  if (auto ok = checkOutput(a.output, {}, {".svg"}, !a.quiet); !ok)
    return std::unexpected(ok.error());
  if (auto written = writeFile(utf8Path(a.output), lawSheet()); !written)
    return std::unexpected(written.error());
  if (!a.quiet) fmt::print("{}: {} laws\n", a.output, everyLaw().size());
  return 0;
}

}  // namespace

Command addLaws(CLI::App& tool) {
  return makeCommand(tool, "laws", "Show every law of motion side by side, moving (.svg)", runLaws);
}

}  // namespace sweepface::cli
