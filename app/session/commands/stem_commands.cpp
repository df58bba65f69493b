#include "app/session/commands/command_table.h"
#include "app/session/document/document.h"
#include "app/session/document/scene_references.h"
#include "engine/core/check.h"
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
  if (c.word_or("interpolation", "smooth") == "linear")
    curve.interpolation = plant::Interpolation::linear;
  // The first stem of a plant stands where its foot is.
  if (plant.curves.empty()) plant.root = curve.points.front();
  plant::add_stem(plant, std::move(curve));
}

void delete_stem(Document& document, const Command& c) {
  plant::remove_stem(edited(document, c), c.word("stem"), c.word_or("branches", "too") != "stay");
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

void insert_point(Document& document, const Command& c) {
  plant::insert_point(edited(document, c), c.word("stem"), c.number("at"));
}

void set_point_kind(Document& document, const Command& c) {
  const std::string& word = c.word("kind");
  plant::PointKind kind = plant::PointKind::smooth;
  if (word == "corner")
    kind = plant::PointKind::corner;
  else if (word == "linear")
    kind = plant::PointKind::linear;
  else if (word != "smooth")
    throw UsageError("kind \"" + word + "\", expected corner, linear or smooth");
  plant::set_point_kind(edited(document, c), c.word("stem"), c.whole("point"), kind);
}

void trim_stem(Document& document, const Command& c) {
  plant::trim_stem(edited(document, c), c.word("stem"), c.number("at"));
}

void delete_point(Document& document, const Command& c) {
  plant::remove_point(edited(document, c), c.word("stem"), c.whole("point"));
}

void set_points(Document& document, const Command& c) {
  plant::set_points(edited(document, c), c.word("stem"), c.points("points"));
}

void smooth_points(Document& document, const Command& c) {
  plant::PlantFile& plant = edited(document, c);
  const int stem = plant::find_stem(plant, c.word("stem"));
  const int last = static_cast<int>(plant.curves[stem].points.size()) - 1;
  plant::smooth_points(plant, c.word("stem"), c.number_or("share", 0.5), c.whole_or("first", 0),
                       c.whole_or("last", last));
}

void move_stem(Document& document, const Command& c) {
  plant::move_stem(edited(document, c), c.word("stem"), c.point("by"));
}

void set_length(Document& document, const Command& c) {
  plant::set_length(edited(document, c), c.word("stem"), c.number("length"));
}

void set_radius(Document& document, const Command& c) {
  plant::set_radius(edited(document, c), c.word("stem"), c.whole_or("point", -1),
                    c.number("radius"));
}

void taper(Document& document, const Command& c) {
  plant::taper(edited(document, c), c.word("stem"), c.number("from"), c.number("to"));
}

void set_interpolation(Document& document, const Command& c) {
  const std::string& word = c.word("interpolation");
  if (word != "linear" && word != "smooth")
    throw UsageError("interpolation \"" + word + "\", expected linear or smooth");
  plant::set_interpolation(
      edited(document, c), c.word("stem"),
      word == "linear" ? plant::Interpolation::linear : plant::Interpolation::smooth);
}

void mirror_stem(Document& document, const Command& c) {
  plant::mirror_stem(edited(document, c), c.word("stem"), c.word_or("name", ""),
                     c.has("normal") ? c.point("normal") : Vec3(Vec3::Zero()));
}

void repeat_stem(Document& document, const Command& c) {
  plant::repeat_stem(edited(document, c), c.word("stem"), c.whole("count"), c.number("spacing"),
                     c.number_or("angle", 0.0));
}

}  // namespace

std::vector<CommandDescription> stem_commands() {
  const Scope d = Scope::document;
  return {
      {"draw stem",
       d,
       {plant_name,
        stem_name,
        {"points", Kind::points, true, "m, in the plant's frame, from the foot on"},
        {"radius", Kind::numbers, true, "m, one or one a point"},
        {"interpolation", Kind::word, false, "smooth (default) or linear"}},
       "Adds a stem; its foot joins the stem that it lies on.",
       draw_stem},
      {"delete stem",
       d,
       {plant_name, stem_name, {"branches", Kind::word, false, "too (default) or stay"}},
       "Takes a stem off with what is on it.",
       delete_stem},
      {"rename",
       d,
       {plant_name,
        {"name", Kind::word, true, "of a stem, fruit or leaf"},
        {"new_name", Kind::word, true, "one that is free"}},
       "Gives a stem, fruit or leaf another name.",
       rename},
      {"move point",
       d,
       {plant_name, stem_name, point_index, {"to", Kind::point, true, "m, in the plant's frame"}},
       "Moves a control point; branches follow.",
       move_point},
      {"insert point",
       d,
       {plant_name, stem_name, {"at", Kind::number, true, "fraction of the stem's length"}},
       "Adds a control point on the stem.",
       insert_point},
      {"set point kind",
       d,
       {plant_name,
        stem_name,
        point_index,
        {"kind", Kind::word, true, "corner, linear (straight beside it, too) or smooth"}},
       "Makes a point a corner by two points close to it that hold it, or smooth again without.",
       set_point_kind},
      {"trim stem",
       d,
       {plant_name, stem_name, {"at", Kind::number, true, "fraction of the stem's length"}},
       "Cuts a stem: what lies beyond, seen from its foot, goes with all that is on it.",
       trim_stem},
      {"delete point",
       d,
       {plant_name, stem_name, point_index},
       "Takes a control point away, with those that hold it.",
       delete_point},
      {"set points",
       d,
       {plant_name, stem_name, {"points", Kind::points, true, "m, in the plant's frame"}},
       "Gives all control points of a stem.",
       set_points},
      {"smooth points",
       d,
       {plant_name,
        stem_name,
        {"share", Kind::number, false, "0 to 1 of the way to the neighbours' middle (0.5)"},
        {"first", Kind::whole, false, "first point (0)"},
        {"last", Kind::whole, false, "last point (the tip)"}},
       "Makes a stem smoother.",
       smooth_points},
      {"move stem",
       d,
       {plant_name, stem_name, {"by", Kind::point, true, "m, in the plant's frame"}},
       "Moves a stem with its branches.",
       move_stem},
      {"set length",
       d,
       {plant_name, stem_name, {"length", Kind::number, true, "m, along the stem"}},
       "Scales a stem about its foot.",
       set_length},
      {"set radius",
       d,
       {plant_name,
        stem_name,
        {"radius", Kind::number, true, "m"},
        {"point", Kind::whole, false, "number of the point; left out: everywhere"}},
       "Sets the radius at a control point, or of the whole stem.",
       set_radius},
      {"taper",
       d,
       {plant_name,
        stem_name,
        {"from", Kind::number, true, "m, radius at the foot"},
        {"to", Kind::number, true, "m, radius at the tip"}},
       "Lets the radius change evenly along a stem.",
       taper},
      {"set interpolation",
       d,
       {plant_name, stem_name, {"interpolation", Kind::word, true, "linear or smooth"}},
       "Straight pieces between control points, or a smooth curve.",
       set_interpolation},
      {"mirror stem",
       d,
       {plant_name,
        stem_name,
        {"name", Kind::word, false, "of the copy"},
        {"normal", Kind::point, false, "of the mirror; left out: the other side of the parent"}},
       "Copies a stem with everything on it, mirrored.",
       mirror_stem},
      {"repeat stem",
       d,
       {plant_name,
        stem_name,
        {"count", Kind::whole, true, "copies"},
        {"spacing", Kind::number, true, "m along the parent, from one to the next"},
        {"angle", Kind::number, false, "rad about the parent, from one to the next"}},
       "Copies a stem with everything on it up its parent.",
       repeat_stem},
  };
}

}  // namespace pedicel::app
