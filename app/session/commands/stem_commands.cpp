#include "app/session/commands/command_table.h"
#include "app/session/document/document.h"
#include "app/session/document/scene_references.h"
#include "plugins/plant/plant_edit.h"
#include "plugins/plant/point_kind.h"

/// Stems as commands: thin covers of plant/plant_edit.h.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

const ArgumentDescription plant_name{"plant", Kind::word, true, "name of the plant in the scene"};
const ArgumentDescription stem_name{"stem", Kind::word, true, "name of the stem"};
const ArgumentDescription point_index{"point", Kind::whole, true, "number of the point, from 0"};

plant::PlantFile& edited(Document& document, const Command& c) {
  return document.edit_plant(c.word("plant"));
}

void draw_stem(Document& document, const Command& c) {
  plant::PlantFile& plant = edited(document, c);
  plant::PlantCurve curve;
  curve.name = c.word("stem");
  curve.points = c.points("points");
  curve.radius = c.numbers("radius");
  curve.interpolation = static_cast<plant::Interpolation>(c.choice("interpolation"));
  // The first stem of a plant stands where its foot is.
  if (plant.curves.empty()) plant.root = curve.points.front();
  plant::add_stem(plant, std::move(curve));
}

void rename(Document& document, const Command& c) {
  plant::rename(edited(document, c), c.word("name"), c.word("new_name"));
  rename_organ_references(document, c.word("plant"), c.word("name"), c.word("new_name"));
}

void move_point(Document& document, const Command& c) {
  plant::PlantFile& plant = edited(document, c);
  const int stem = plant::find_stem(plant, c.word("stem"));
  const bool carries_root =
      plant.curves[stem].points.front() == plant.root && c.whole("point") == 0;
  plant::move_point(plant, c.word("stem"), c.whole("point"), c.point("to"));
  if (carries_root) plant.root = c.point("to");
}

void smooth_points(Document& document, const Command& c) {
  plant::PlantFile& plant = edited(document, c);
  const int stem = plant::find_stem(plant, c.word("stem"));
  const int last = static_cast<int>(plant.curves[stem].points.size()) - 1;
  plant::smooth_points(plant, c.word("stem"), c.number_or("share", 0.5), c.whole_or("first", 0),
                       c.whole_or("last", last));
}

}  // namespace

std::vector<CommandDescription> stem_commands() {
  const std::vector<std::string> interpolations(std::begin(plant::interpolation_words),
                                                std::end(plant::interpolation_words));
  return {
      {"draw stem",
       {plant_name,
        stem_name,
        {"points", Kind::points, true, "m, in the plant's frame, from the foot on"},
        {"radius", Kind::numbers, true, "m, one or one a point"},
        {"interpolation", Kind::word, false, "smooth (default) or linear", {}, interpolations}},
       "Adds a stem; its foot joins the stem that it lies on.",
       draw_stem},
      {"delete stem",
       {plant_name,
        stem_name,
        {"branches", Kind::word, false, "too (default) or stay", {}, {"too", "stay"}}},
       "Takes a stem off with what is on it.",
       [](Document& document, const Command& c) {
         plant::remove_stem(edited(document, c), c.word("stem"), c.choice("branches") == 0);
       }},
      {"rename",
       {plant_name,
        {"name", Kind::word, true, "of a stem, fruit or leaf"},
        {"new_name", Kind::word, true, "one that is free"}},
       "Gives a stem, fruit or leaf another name.",
       rename},
      {"move point",
       {plant_name, stem_name, point_index, {"to", Kind::point, true, "m, in the plant's frame"}},
       "Moves a control point; branches follow.",
       move_point},
      {"insert point",
       {plant_name, stem_name, {"at", Kind::number, true, "fraction of the stem's length"}},
       "Adds a control point on the stem.",
       [](Document& document, const Command& c) {
         plant::insert_point(edited(document, c), c.word("stem"), c.number("at"));
       }},
      {"set point kind",
       {plant_name,
        stem_name,
        point_index,
        {"kind",
         Kind::word,
         true,
         "corner, linear (straight beside it, too) or smooth",
         {},
         {"smooth", "corner", "linear"}}},
       "Makes a point a corner by two points close to it that hold it, or smooth again without.",
       [](Document& document, const Command& c) {
         plant::set_point_kind(edited(document, c), c.word("stem"), c.whole("point"),
                               static_cast<plant::PointKind>(c.choice("kind")));
       }},
      {"trim stem",
       {plant_name, stem_name, {"at", Kind::number, true, "fraction of the stem's length"}},
       "Cuts a stem: what lies beyond, seen from its foot, goes with all that is on it.",
       [](Document& document, const Command& c) {
         plant::trim_stem(edited(document, c), c.word("stem"), c.number("at"));
       }},
      {"delete point",
       {plant_name, stem_name, point_index},
       "Takes a control point away, with those that hold it.",
       [](Document& document, const Command& c) {
         plant::remove_point(edited(document, c), c.word("stem"), c.whole("point"));
       }},
      {"set points",
       {plant_name, stem_name, {"points", Kind::points, true, "m, in the plant's frame"}},
       "Gives all control points of a stem.",
       [](Document& document, const Command& c) {
         plant::set_points(edited(document, c), c.word("stem"), c.points("points"));
       }},
      {"smooth points",
       {plant_name,
        stem_name,
        {"share", Kind::number, false, "0 to 1 of the way to the neighbours' middle (0.5)"},
        {"first", Kind::whole, false, "first point (0)"},
        {"last", Kind::whole, false, "last point (the tip)"}},
       "Makes a stem smoother.",
       smooth_points},
      {"move stem",
       {plant_name, stem_name, {"by", Kind::point, true, "m, in the plant's frame"}},
       "Moves a stem with its branches.",
       [](Document& document, const Command& c) {
         plant::move_stem(edited(document, c), c.word("stem"), c.point("by"));
       }},
      {"set length",
       {plant_name, stem_name, {"length", Kind::number, true, "m, along the stem"}},
       "Scales a stem about its foot.",
       [](Document& document, const Command& c) {
         plant::set_length(edited(document, c), c.word("stem"), c.number("length"));
       }},
      {"set radius",
       {plant_name,
        stem_name,
        {"radius", Kind::number, true, "m"},
        {"point", Kind::whole, false, "number of the point; left out: everywhere"}},
       "Sets the radius at a control point, or of the whole stem.",
       [](Document& document, const Command& c) {
         plant::set_radius(edited(document, c), c.word("stem"), c.whole_or("point", -1),
                           c.number("radius"));
       }},
      {"taper",
       {plant_name,
        stem_name,
        {"from", Kind::number, true, "m, radius at the foot"},
        {"to", Kind::number, true, "m, radius at the tip"}},
       "Lets the radius change evenly along a stem.",
       [](Document& document, const Command& c) {
         plant::taper(edited(document, c), c.word("stem"), c.number("from"), c.number("to"));
       }},
      {"set interpolation",
       {plant_name,
        stem_name,
        {"interpolation", Kind::word, true, "linear or smooth", {}, interpolations}},
       "Straight pieces between control points, or a smooth curve.",
       [](Document& document, const Command& c) {
         plant::set_interpolation(edited(document, c), c.word("stem"),
                                  static_cast<plant::Interpolation>(c.choice("interpolation")));
       }},
      {"mirror stem",
       {plant_name,
        stem_name,
        {"name", Kind::word, false, "of the copy"},
        {"normal", Kind::point, false, "of the mirror; left out: the other side of the parent"}},
       "Copies a stem with everything on it, mirrored.",
       [](Document& document, const Command& c) {
         plant::mirror_stem(edited(document, c), c.word("stem"), c.word_or("name", ""),
                            c.has("normal") ? c.point("normal") : Vec3(Vec3::Zero()));
       }},
      {"repeat stem",
       {plant_name,
        stem_name,
        {"count", Kind::whole, true, "copies"},
        {"spacing", Kind::number, true, "m along the parent, from one to the next"},
        {"angle", Kind::number, false, "rad about the parent, from one to the next"}},
       "Copies a stem with everything on it up its parent.",
       [](Document& document, const Command& c) {
         plant::repeat_stem(edited(document, c), c.word("stem"), c.whole("count"),
                            c.number("spacing"), c.number_or("angle", 0.0));
       }},
  };
}

}  // namespace pedicel::app
