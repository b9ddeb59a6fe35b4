// Parses the text of a drawing, member by member (docs/wire-format.md).
#include <algorithm>
#include <fmt/format.h>
#include <functional>

#include "codec/grid_size.hpp"
#include "codec/limits.hpp"
#include "drawing/json_reader.hpp"
#include "drawing/words.hpp"
#include "io/single.hpp"
#include "io/text.hpp"

namespace sweepface {

namespace drawing {
namespace {

class DrawingReader {
 public:
  explicit DrawingReader(std::string_view text) : in_(text) {}

  Result<Drawing> read(std::string_view source) {
    drawing_.source = source;
    members("the drawing",
            {{"format", [&] { format(); }, true},
             {"$schema", [&] { in_.text("a text in quotes"); }},
             {"units", [&] { drawing_.units = text("the units"); }},
             {"tolerance", [&] { tolerance(); }},
             {"nodes", [&] { list("the nodes", [&] { node(); }); }, true},
             {"curves", [&] { list("the curves", [&] { curve(); }); }, true},
             {"controls", [&] { list("the controls", [&] { control(); }); }},
             {"patches", [&] { list("the patches", [&] { patch(); }); }, true},
             {"ribbons", [&] { list("the ribbons", [&] { ribbon(); }); }},
             {"creases", [&] { list("the creases", [&] { crease(); }); }},
             {"expressions", [&] { list("the expressions", [&] { expression(); }); }}});
    in_.finish();
    if (in_.ok()) return std::move(drawing_);
    const auto [line, column] = in_.problemPlace();
    return fail(fmt::format("{}, line {}, column {}: {}.", source, line, column, in_.problem()));
  }

 private:
  struct Member {
    std::string_view key;
    std::function<void()> read;
    bool required = false;
  };

  // Reads an object with any of the `known` members, and possibly a comment.
  void members(std::string_view what, const std::vector<Member>& known) {
    const TextPlace start = in_.place();
    std::vector<bool> seen(known.size());
    in_.object(what, [&](const std::string& key, const TextPlace& at) {
      const auto found = std::ranges::find(known, key, &Member::key);
      if (found != known.end()) {
        seen[found - known.begin()] = true;
        found->read();
      } else if (key == "comment") {
        in_.text("a comment in quotes");
      } else {
        in_.refuse(at, fmt::format("{} is not known in {}; known are {}", io::inQuotes(key), what,
                                   listOf(known)));
      }
    });
    for (std::size_t k = 0; k < known.size(); ++k)
      if (known[k].required && !seen[k])
        in_.refuse(start, fmt::format("{} needs '{}'", what, known[k].key));
  }

  static std::string listOf(const std::vector<Member>& known) {
    std::string list;
    for (const Member& member : known) list += fmt::format("'{}', ", member.key);
    return list + "'comment'";
  }

  void list(std::string_view what, const std::function<void()>& element) {
    in_.array(what, element);
  }

  void format() {
    const TextPlace at = in_.place();
    const std::string format = in_.text("the format in quotes");
    if (format != kFormat)
      in_.refuse(at, fmt::format("the format is {} and this program reads '{}'",
                                 io::inQuotes(format), kFormat));
  }

  void tolerance() {
    const TextPlace at = in_.place();
    drawing_.tolerance = in_.number("the tolerance, a number,");
    if (!(drawing_.tolerance > 0))
      in_.refuse(at, "the tolerance is not above 0; leave it out to be told how far curves pass");
  }

  // A text that may be quoted in messages and in the file.
  std::string text(std::string_view what) {
    const TextPlace at = in_.place();
    std::string text = in_.text(fmt::format("{}, a text in quotes,", what));
    if (!isName(text))
      in_.refuse(at, fmt::format("{} is empty, has control characters or is no UTF-8", what));
    if (text.size() > codec::kLongestName)
      in_.refuse(at, fmt::format("{} is longer than {} bytes", what, codec::kLongestName));
    return text;
  }

  // A name that cannot be taken for a number or for a curve run backwards.
  std::string name(std::string_view what) {
    const TextPlace at = in_.place();
    std::string name = text(what);
    const bool isNumber = name.find_first_not_of("0123456789") == std::string::npos;
    if (isNumber || name[0] == '-')
      in_.refuse(at, fmt::format("{} must not be a number or begin with '-'", what));
    return name;
  }

  // A reference to a name, possibly with a '-' before it.
  std::string reference(std::string_view what) {
    const TextPlace at = in_.place();
    std::string name = in_.text(fmt::format("{}, a name in quotes,", what));
    if (name.empty())
      in_.refuse(at, fmt::format("{} has no name; leave it out if there is none", what));
    return name;
  }

  Vec3 vector(std::string_view what) {
    const TextPlace at = in_.place();
    double values[3]{};
    int count = 0;
    in_.array(fmt::format("{}, three numbers", what), [&] {
      const TextPlace number = in_.place();
      const double value = in_.number("a number");
      if (!io::isSingle(value)) in_.refuse(number, "a coordinate is beyond what a float can hold");
      if (count < 3) values[count] = value;
      ++count;
    });
    if (count != 3) in_.refuse(at, fmt::format("{} has {} numbers instead of three", what, count));
    return {values[0], values[1], values[2]};
  }

  std::vector<Vec3> vectors(std::string_view what) {
    std::vector<Vec3> list;
    in_.array(what, [&] { list.push_back(vector("a point")); });
    return list;
  }

  void node() {
    Drawing::Node node;
    node.place = in_.place();
    members(
        "a node",
        {{"name", [&] { node.name = name("the name of a node"); }, true},
         {"at", [&] { node.at = vector("the place of a node"); }},
         {"with", [&] { node.with = reference("the node it stands with"); }},
         {"jet", [&] { node.jets.push_back(jet()); }},
         {"jets", [&] { in_.array("the jets of a node", [&] { node.jets.push_back(jet()); }); }}});
    drawing_.nodes.push_back(std::move(node));
  }

  Drawing::Jet jet() {
    Drawing::Jet jet;
    std::vector<Member> known{
        {"along", [&] { jet.along = reference("the curve x runs along"); }, true}};
    for (std::size_t k = 1; k < kJetWords.size(); ++k)
      known.push_back({kJetWords[k], [this, &jet, k] { jet.vectors[k] = vector("a derivative"); }});
    members("a jet", known);
    return jet;
  }

  void curve() {
    Drawing::Curve curve;
    curve.place = in_.place();
    members("a curve", {{"name", [&] { curve.name = name("the name of a curve"); }, true},
                        {"from", [&] { curve.from = reference("the node it leaves"); }, true},
                        {"to", [&] { curve.to = reference("the node it reaches"); }, true},
                        {"points", [&] { curve.points = vectors("the points of a curve"); }},
                        {"edges", [&] { curve.edges = edges(); }},
                        {"ribbon", [&] { curve.ribbon = reference("the ribbon of a curve"); }},
                        {"collapsed", [&] { curve.collapsed = in_.flag("true or false"); }}});
    drawing_.curves.push_back(std::move(curve));
  }

  Index edges() {
    constexpr Index most = codec::kLongestArc;
    const TextPlace at = in_.place();
    const double edges = in_.number("the number of edges");
    const bool fits = edges >= 1 && edges <= most && edges == static_cast<Index>(edges);
    if (!fits) in_.refuse(at, fmt::format("the edges must be a whole number from 1 to {}", most));
    return fits ? static_cast<Index>(edges) : 0;
  }

  void control() {
    Drawing::Control control;
    control.place = in_.place();
    const auto points = [&] { return vectors("the points of a control curve"); };
    members("a control",
            {{"beside", [&] { control.beside = reference("the boundary curve"); }, true},
             {"in", [&] { control.in = reference("the patch"); }, true},
             {"second", [&] { control.second = points(); }, true},
             {"third", [&] { control.third = points(); }, true},
             {"spacing", [&] { control.spacing = spacing(); }}});
    drawing_.controls.push_back(std::move(control));
  }

  ControlSpacing spacing() {
    const TextPlace at = in_.place();
    std::vector<double> u;
    in_.array("the spacing, two numbers,", [&] { u.push_back(in_.number("a number")); });
    if (u.size() == 2 && u[0] > 0 && u[1] > u[0] && u[1] <= 1) return {u[0], u[1]};
    in_.refuse(at,
               "the spacing must be two shares of the way across, above 0 and at most 1, the "
               "smaller one first");
    return {};
  }

  void patch() {
    Drawing::Patch patch;
    patch.place = in_.place();
    members("a patch", {{"name", [&] { patch.name = name("the name of a patch"); }},
                        {"sides", [&] { patch.sides = sides(); }, true},
                        {"material", [&] { patch.material = text("the material of a patch"); }}});
    drawing_.patches.push_back(std::move(patch));
  }

  std::vector<std::vector<std::string>> sides() {
    std::vector<std::vector<std::string>> sides;
    in_.array("the sides of a patch", [&] {
      auto& side = sides.emplace_back();
      if (in_.nextIsArray())
        in_.array("a side", [&] { side.push_back(reference("a curve")); });
      else
        side.push_back(reference("a side, a curve or a list of curves: a curve"));
    });
    return sides;
  }

  void ribbon() {
    Drawing::Ribbon ribbon;
    ribbon.place = in_.place();
    Shape& shape = ribbon.shape;
    members("a ribbon", {{"name", [&] { ribbon.name = name("the name of a ribbon"); }, true},
                         {"rho", [&] { shape.rho = in_.number("rho, a number,"); }},
                         {"eta", [&] { shape.eta = in_.number("eta, a number,"); }},
                         {"lambda", [&] { shape.lambda = in_.number("lambda, a number,"); }}});
    drawing_.ribbons.push_back(std::move(ribbon));
  }

  void crease() {
    const TextPlace at = in_.place();
    drawing_.creases.push_back({reference("a crease, a curve:"), at});
  }

  void expression() {
    Drawing::Expression expression;
    expression.place = in_.place();
    members("an expression",
            {{"name", [&] { expression.name = text("the name of an expression"); }, true},
             {"moves", [&] { moves(expression.moves); }, true}});
    drawing_.expressions.push_back(std::move(expression));
  }

  void moves(std::vector<Drawing::Move>& moves) {
    in_.object("the moves", [&](const std::string& name, const TextPlace& at) {
      Drawing::Move& move = moves.emplace_back();
      move.name = name;
      move.place = at;
      if (in_.nextIsArray())
        move.by = vector("an offset");
      else
        moveParts(move);
    });
  }

  void moveParts(Drawing::Move& move) {
    std::vector<std::pair<int, Vec3>> jet;
    std::vector<Member> known{{"by", [&] { move.by = vector("an offset"); }},
                              {"points", [&] { move.points = vectors("the offsets of points"); }},
                              {"jets", [&] { moveJets(move); }}};
    addJetMembers(known, jet);
    members("a move", known);
    if (!jet.empty()) move.jets.insert(move.jets.begin(), std::move(jet));
  }

  void moveJets(Drawing::Move& move) {
    in_.array("the offsets of jets", [&] {
      std::vector<Member> known;
      addJetMembers(known, move.jets.emplace_back());
      members("the offsets of a jet", known);
    });
  }

  void addJetMembers(std::vector<Member>& known, std::vector<std::pair<int, Vec3>>& jet) {
    for (std::size_t k = 1; k < kJetWords.size(); ++k)
      known.push_back({kJetWords[k], [this, &jet, k] {
                         jet.emplace_back(static_cast<int>(k), vector("an offset"));
                       }});
  }

  JsonReader in_;
  Drawing drawing_;
};

}  // namespace
}  // namespace drawing

Result<Drawing> parseDrawing(std::string_view text, std::string_view name) {
  return drawing::DrawingReader(text).read(name);
}

}  // namespace sweepface
