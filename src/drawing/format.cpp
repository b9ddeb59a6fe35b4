// Writes a drawing as text, one thing per line, so that people can find it and tools can compare
// it.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "sweepface/drawing.hpp"

#include "drawing/words.hpp"

namespace sweepface {

namespace drawing {
namespace {

class Formatter {
 public:
  std::string format(const Drawing& d) {
    append("{{\n  \"format\": {}", quoted(kFormat));
    if (!d.units.empty()) append(",\n  \"units\": {}", quoted(d.units));
    if (d.tolerance > 0) append(",\n  \"tolerance\": {}", d.tolerance);
    list("nodes", d.nodes, [&](const Drawing::Node& n) { node(n); });
    list("curves", d.curves, [&](const Drawing::Curve& c) { curve(c); });
    if (!d.controls.empty())
      list("controls", d.controls, [&](const Drawing::Control& c) { control(c); });
    list("patches", d.patches, [&](const Drawing::Patch& p) { patch(p); });
    if (!d.ribbons.empty())
      list("ribbons", d.ribbons, [&](const Drawing::Ribbon& r) { ribbon(r); });
    if (!d.creases.empty())
      list("creases", d.creases, [&](const Drawing::Crease& c) { append("{}", quoted(c.curve)); });
    if (!d.expressions.empty())
      list("expressions", d.expressions, [&](const Drawing::Expression& e) { expression(e); });
    append("\n}}\n");
    return std::move(text_);
  }

 private:
  template <typename... Arguments>
  void append(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
  }

  static std::string quoted(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') result += '\\';
      if (static_cast<unsigned char>(c) < ' ')
        result += fmt::format("\\u{:04x}", c);
      else
        result += c;
    }
    return result + '"';
  }

  template <typename Things, typename Write>
  void list(std::string_view name, const Things& things, Write write) {
    append(",\n  \"{}\": [", name);
    std::string_view separator = "\n    ";
    for (const auto& thing : things) {
      append("{}", separator);
      write(thing);
      separator = ",\n    ";
    }
    append("{}]", things.empty() ? "" : "\n  ");
  }

  void vector(const Vec3& v) { append("[{}, {}, {}]", v.x, v.y, v.z); }
  void vectors(std::string_view name, const std::vector<Vec3>& list) {
    append(", \"{}\": [", name);
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (k > 0) append(", ");
      vector(list[k]);
    }
    append("]");
  }

  void node(const Drawing::Node& n) {
    append("{{\"name\": {}", quoted(n.name));
    if (n.at) {
      append(", \"at\": ");
      vector(*n.at);
    }
    if (!n.with.empty()) append(", \"with\": {}", quoted(n.with));
    if (n.jets.size() == 1) {
      append(", \"jet\": ");
      jet(n.jets[0]);
    }
    for (std::size_t f = 0; f < n.jets.size() && n.jets.size() > 1; ++f) {
      append("{}", f == 0 ? ", \"jets\": [" : ", ");
      jet(n.jets[f]);
    }
    if (n.jets.size() > 1) append("]");
    append("}}");
  }

  void jet(const Drawing::Jet& j) {
    append("{{\"along\": {}", quoted(j.along));
    for (std::size_t k = 1; k < kJetWords.size(); ++k)
      if (j.vectors[k]) derivative(static_cast<int>(k), *j.vectors[k]);
    append("}}");
  }
  void derivative(int k, const Vec3& value) {
    append(", \"{}\": ", kJetWords[static_cast<std::size_t>(k)]);
    vector(value);
  }

  void curve(const Drawing::Curve& c) {
    append("{{\"name\": {}, \"from\": {}, \"to\": {}", quoted(c.name), quoted(c.from),
           quoted(c.to));
    if (!c.points.empty()) vectors("points", c.points);
    if (c.edges > 0) append(", \"edges\": {}", c.edges);
    if (!c.ribbon.empty()) append(", \"ribbon\": {}", quoted(c.ribbon));
    if (c.collapsed) append(", \"collapsed\": true");
    append("}}");
  }

  void control(const Drawing::Control& c) {
    append("{{\"beside\": {}, \"in\": {}", quoted(c.beside), quoted(c.in));
    if (c.spacing) append(", \"spacing\": [{}, {}]", c.spacing->u2, c.spacing->u3);
    vectors("second", c.second);
    vectors("third", c.third);
    append("}}");
  }

  void patch(const Drawing::Patch& p) {
    append("{{");
    if (!p.name.empty()) append("\"name\": {}, ", quoted(p.name));
    append("\"sides\": [");
    for (std::size_t s = 0; s < p.sides.size(); ++s) {
      if (s > 0) append(", ");
      side(p.sides[s]);
    }
    append("]");
    if (!p.material.empty()) append(", \"material\": {}", quoted(p.material));
    append("}}");
  }

  void side(const std::vector<std::string>& curves) {
    if (curves.size() != 1) append("[");
    for (std::size_t k = 0; k < curves.size(); ++k)
      append("{}{}", k > 0 ? ", " : "", quoted(curves[k]));
    if (curves.size() != 1) append("]");
  }

  void ribbon(const Drawing::Ribbon& r) {
    append("{{\"name\": {}", quoted(r.name));
    const auto parameter = [&](const char* word, double value, double usual) {
      const bool said = value != usual || std::signbit(value);
      if (said) append(", \"{}\": {}", word, value);
    };
    parameter("rho", r.shape.rho, 1);
    parameter("eta", r.shape.eta, 0);
    parameter("lambda", r.shape.lambda, 0);
    append("}}");
  }

  void expression(const Drawing::Expression& e) {
    append("{{\"name\": {}, \"moves\": {{", quoted(e.name));
    std::string_view separator = "\n      ";
    for (const Drawing::Move& m : e.moves) {
      append("{}{}: ", separator, quoted(m.name));
      move(m);
      separator = ",\n      ";
    }
    append("{}}}}}", e.moves.empty() ? "" : "\n    ");
  }

  void move(const Drawing::Move& m) {
    const bool onlyBy = std::ranges::all_of(m.jets, [](const auto& jet) { return jet.empty(); });
    if (onlyBy && m.points.empty()) return vector(m.by);
    append("{{\"by\": ");
    vector(m.by);
    if (m.jets.size() == 1)
      for (const auto& [k, offset] : m.jets[0]) derivative(k, offset);
    if (m.jets.size() > 1) moveJets(m);
    if (!m.points.empty()) vectors("points", m.points);
    append("}}");
  }
  void moveJets(const Drawing::Move& m) {
    append(", \"jets\": [");
    for (std::size_t f = 0; f < m.jets.size(); ++f) {
      append("{}{{", f > 0 ? ", " : "");
      for (std::size_t k = 0; k < m.jets[f].size(); ++k) {
        append("{}\"{}\": ", k > 0 ? ", " : "",
               kJetWords[static_cast<std::size_t>(m.jets[f][k].first)]);
        vector(m.jets[f][k].second);
      }
      append("}}");
    }
    append("]");
  }

  std::string text_;
};

}  // namespace
}  // namespace drawing

std::string formatDrawing(const Drawing& d) { return drawing::Formatter().format(d); }

}  // namespace sweepface
