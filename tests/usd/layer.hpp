#pragma once

#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sweepface/vec.hpp"

// Reads written layers independently of the library, as far as they have the usual shape of
// OpenUSD's.
namespace sweepface::testing {

class Layer {
 public:
  explicit Layer(const std::string& text) {
    EXPECT_TRUE(text.starts_with("#usda 1.0\n"));
    std::istringstream lines(text);
    std::string path;
    for (std::string line; std::getline(lines, line);) {
      line.erase(0, line.find_first_not_of(' '));
      if (const std::size_t name = line.find('"'); line.starts_with("def ")) {
        path += "/" + line.substr(name + 1, line.find('"', name + 1) - name - 1);
        EXPECT_TRUE(types_.emplace(path, line.substr(4, name - 5)).second) << path;
        isIn_.push_back(true);
      } else if (line.ends_with("timeSamples = {")) {
        isIn_.push_back(false);
      } else if (line == "}") {
        if (isIn_.back()) path.resize(path.rfind('/'));
        isIn_.pop_back();
      } else if (const std::size_t is = line.find(" = "); is != std::string::npos) {
        std::string value = line.substr(is + 3);
        if (value.ends_with(" (")) value.resize(value.size() - 2);
        values_.emplace(path + "." + line.substr(0, is), value);
      } else if (const std::size_t colon = line.find(": ["); colon != std::string::npos) {
        samples_[path].emplace_back(line.substr(0, colon), line.substr(colon + 2));
      }
    }
    EXPECT_TRUE(isIn_.empty());
  }

  std::string type(const std::string& prim) const {
    const auto found = types_.find(prim);
    return found == types_.end() ? "" : found->second;
  }
  bool has(const std::string& property) const { return values_.contains(property); }
  /// What stands behind the = of `/prim.type property`.
  std::string value(const std::string& property) const {
    const auto found = values_.find(property);
    if (found != values_.end()) return found->second;
    ADD_FAILURE() << "no " << property;
    return {};
  }
  /// The time samples of a prim, which are all of one property: their times and values.
  std::vector<std::pair<std::string, std::string>> samples(const std::string& prim) const {
    const auto found = samples_.find(prim);
    return found == samples_.end() ? decltype(found->second){} : found->second;
  }

  std::vector<double> numbers(const std::string& property) const {
    return numbersIn(value(property));
  }
  std::vector<Vec3> vectors(const std::string& property) const {
    const std::vector<double> all = numbers(property);
    EXPECT_EQ(all.size() % 3, 0u);
    std::vector<Vec3> list;
    for (std::size_t k = 0; k + 2 < all.size(); k += 3)
      list.push_back({all[k], all[k + 1], all[k + 2]});
    return list;
  }
  static std::vector<double> numbersIn(std::string text) {
    for (char& c : text)
      if (c == '[' || c == ']' || c == '(' || c == ')' || c == ',') c = ' ';
    std::istringstream stream(text);
    std::vector<double> list;
    for (double number = 0; stream >> number;) list.push_back(number);
    EXPECT_TRUE(stream.eof()) << text.substr(0, 100);
    return list;
  }

 private:
  std::map<std::string, std::string> types_, values_;
  std::map<std::string, std::vector<std::pair<std::string, std::string>>> samples_;
  std::vector<bool> isIn_;  // whether each brace that is open is a prim's
};

}  // namespace sweepface::testing
