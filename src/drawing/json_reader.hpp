#pragma once

#include <set>
#include <string>
#include <string_view>

#include "sweepface/drawing.hpp"

#include "io/text.hpp"

namespace sweepface::drawing {

/// A pull parser for JSON: the caller takes the values that it expects, one after another. Only the
/// keys of open objects are kept, so neither the size nor the depth of a text costs memory. The
/// first failure sticks: from then on everything reads as empty, so callers need to check ok() only
/// before they rely on what they have read.
class JsonReader {
 public:
  explicit JsonReader(std::string_view text) : text_(text) { skipBlanks(); }

  bool ok() const { return problem_.empty(); }
  const std::string& problem() const { return problem_; }
  const TextPlace& problemPlace() const { return problemPlace_; }

  /// Where the next value begins.
  TextPlace place() const { return {line_, at_ - lineStart_ + 1}; }
  /// Fails at a place, unless something has failed before.
  void refuse(const TextPlace& place, std::string problem);

  bool nextIsArray() const { return peek() == '['; }

  std::string text(std::string_view what);
  double number(std::string_view what);  ///< finite
  bool flag(std::string_view what);

  /// Calls visit(key, place of the key) for each member; it must take the member's value.
  template <typename Visit>
  void object(std::string_view what, Visit visit) {
    if (!open('{', what, "an object {...}")) return;
    std::set<std::string> keys;
    for (bool more = !closes('}'); more && ok(); more = continues('}')) {
      const TextPlace at = place();
      const std::string key = text("a name in quotes");
      if (ok() && !keys.insert(key).second) refuse(at, io::inQuotes(key) + " is given twice");
      if (!ok() || !take(':', "':' after the name")) return;
      visit(key, at);
    }
  }

  /// Calls visit() for each element; it must take the element.
  template <typename Visit>
  void array(std::string_view what, Visit visit) {
    if (!open('[', what, "a list [...]")) return;
    for (bool more = !closes(']'); more && ok(); more = continues(']')) visit();
  }

  /// Fails if anything follows.
  void finish();

 private:
  char peek() const { return ok() && at_ < text_.size() ? text_[at_] : '\0'; }
  void skipBlanks();
  std::string found() const;
  void expected(std::string_view what);
  bool open(char bracket, std::string_view what, std::string_view kind);
  bool closes(char bracket);
  bool continues(char bracket);
  bool take(char c, std::string_view what);
  void escape(std::string& out);
  unsigned hex4();

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1, lineStart_ = 0;
  std::string problem_;
  TextPlace problemPlace_;
};

}  // namespace sweepface::drawing
