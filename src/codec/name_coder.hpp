#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "codec/limits.hpp"
#include "codec/symbols.hpp"

namespace sweepface::codec {

/// The usual names of expressions: ARKit's blend shapes in alphabetical order. A name that ends
/// with a comma has a left and a right variant.
inline constexpr char kUsualNames[] =
    "browDown,browInnerUp browOuterUp,cheekPuff cheekSquint,eyeBlink,eyeLookDown,eyeLookIn,"
    "eyeLookOut,eyeLookUp,eyeSquint,eyeWide,jawForward jawLeft jawOpen jawRight mouthClose "
    "mouthDimple,mouthFrown,mouthFunnel mouthLeft mouthLowerDown,mouthPress,mouthPucker mouthRight "
    "mouthRollLower mouthRollUpper mouthShrugLower mouthShrugUpper mouthSmile,mouthStretch,"
    "mouthUpperUp,noseSneer,tongueOut ";

/// Codes names one after another. Each letter is first compared with the one that followed the
/// latest occurrence of the preceding letters, in the usual names or the names so far (a match
/// model, after Ziv and Lempel, 1977). If they differ, it is coded in the context of the preceding
/// letters.
template <typename Coder>
class NameCoder {
 public:
  explicit NameCoder(Symbols<Coder>& symbols) : s_(symbols), lastAfter_(std::size_t{1} << kBits) {
    learnUsual("_L", "_R");
    learnUsual("Left", "Right");
  }

  std::string code(std::string_view name) {
    const std::size_t begin = text_.size();
    for (std::size_t k = 0; codeLetter(k < name.size() ? name[k] : '\0') != 0 && s_.ok(); ++k)
      if (k >= kLongestName) s_.refuse("a name is too long");
    return {text_.begin() + static_cast<std::ptrdiff_t>(begin), text_.end() - 1};
  }

 private:
  enum Tag : std::uint32_t { kLetter = 44, kAsLast = 56 };
  static constexpr int kBits = 12;
  static constexpr std::uint32_t kFewest = 3, kMost = 15;

  void learnUsual(const char* left, const char* right) {
    const char* begin = kUsualNames;
    for (const char* c = begin; *c != 0; ++c) {
      if (*c == ',') {
        learnAll(left);
        learn(0);
        while (begin < c) learn(*begin++);
        learnAll(right);
      }
      learn(*c >= 'A' ? *c : '\0');
      if (*c < 'A') begin = c + 1;
    }
  }
  void learnAll(const char* letters) {
    while (*letters != 0) learn(*letters++);
  }

  char codeLetter(char told) {
    if (follows_ > 0) {
      const char guess = text_[follows_];
      if (s_.bit(kAsLast, std::min(alike_, kMost), static_cast<unsigned char>(guess),
                 told == guess)) {
        ++follows_, ++alike_;
        learn(guess);
        return guess;
      }
    }
    std::uint32_t known = 1;
    for (int b = 8; b-- > 0;)
      known = known << 1 |
              s_.bit(kLetter, known * 256 + (past_ & 255), past_ >> 8 & 0xffff, told >> b & 1);
    learn(static_cast<char>(known));
    seek();
    return static_cast<char>(known);
  }

  std::uint32_t& placeOf(std::uint32_t past) {
    return lastAfter_[(past & 0xffffff) * 0x9e3779b1u >> (32 - kBits)];
  }
  void learn(char letter) {
    text_.push_back(letter);
    past_ = past_ << 8 | static_cast<unsigned char>(letter);
    before_ = placeOf(past_);
    placeOf(past_) = static_cast<std::uint32_t>(text_.size());
  }
  // Finds the previous occurrence of the latest letters, if enough of them match.
  void seek() {
    follows_ = before_;
    for (alike_ = 0; alike_ < std::min(kMost, follows_); ++alike_)
      if (text_[follows_ - 1 - alike_] != text_[text_.size() - 1 - alike_]) break;
    if (alike_ < kFewest) follows_ = 0;
  }

  Symbols<Coder>& s_;
  std::vector<char> text_;                // the usual names and all so far, zero-terminated
  std::vector<std::uint32_t> lastAfter_;  // [2^kBits] by three letters: where they ended last
  std::uint32_t past_ = 0, before_ = 0;   // the last four letters; where the three ended before
  std::uint32_t follows_ = 0;             // the place of the next guess, or 0
  std::uint32_t alike_ = 0;               // how many letters before it match the last ones
};

}  // namespace sweepface::codec
