#pragma once

#include <benchmark/benchmark.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sweepface::bench {

/// Registers the evaluator and what it is compared with; ends the program if that would say
/// nothing.
void registerPlayers();

/// Prints as usual and remembers what the ratios need.
class Ratios : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;
  /// The evaluator's figures as shares of the fastest kernel's: "all=0.62 ten=0.81 ...". With the
  /// suffix "-equal", only kernels that drop as much as the evaluator count.
  std::string line(const std::string& suffix = "") const;

 private:
  struct Figures {
    std::vector<double> seconds;  // of every repetition
    double bytes = 0;
    double median() const;
  };
  const std::pair<const std::string, Figures>* fastestPeer(const std::string& group) const;

  std::map<std::string, std::map<std::string, Figures>> groups_;
};

}  // namespace sweepface::bench
