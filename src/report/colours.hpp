#pragma once

// The colours of plots and drawings of laws.
namespace sweepface {

inline constexpr const char *kInk = "#24262b", *kSoft = "#6b6f78", *kGrid = "#dcdad6",
                            *kGrey = "#8a8e96", *kBlue = "#1a6aa8", *kGreen = "#2a9d55",
                            *kRed = "#d63f29";

}  // namespace sweepface
