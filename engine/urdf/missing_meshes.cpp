#include "engine/urdf/missing_meshes.h"

#include <algorithm>
#include <set>

#include "engine/urdf/urdf_remarks.h"

namespace pedicel::robot {

namespace {

using Group = std::vector<const MissingMesh*>;

/// Names of links, each once, in the order of the file.
std::vector<std::string> links_without_contact(const Group& group) {
  std::vector<std::string> links;
  for (const MissingMesh* mesh : group)
    if (mesh->collision && std::find(links.begin(), links.end(), mesh->link) == links.end())
      links.push_back(mesh->link);
  return links;
}

std::string sentence(const Group& group) {
  const MissingMesh& first = *group.front();
  std::set<std::string> names;
  for (const MissingMesh* mesh : group) names.insert(mesh->name);
  std::string text = first.package.empty() ? "" : "package '" + first.package + "': ";
  if (names.size() == 1)
    text += "mesh file \"" + first.name + "\" of link '" + first.link + "'";
  else
    text += std::to_string(names.size()) + " mesh files, first \"" + first.name + "\" of link '" +
            first.link + "'";
  text += ": " + first.reason;
  if (!first.looked_in.empty()) text += ", looked for " + first.looked_in;
  const std::vector<std::string> links = links_without_contact(group);
  text += links.empty() ? "; not drawn" : "; no contact there of " + first_names(links);
  return text + (first.advice.empty() ? "" : "; " + first.advice);
}

}  // namespace

void report_missing(const std::vector<MissingMesh>& all, Diagnostics& diagnostics) {
  std::vector<Group> groups;
  for (const MissingMesh& mesh : all) {
    const auto same = [&](const Group& group) {
      return group.front()->package == mesh.package && group.front()->reason == mesh.reason;
    };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) group = groups.insert(groups.end(), Group{});
    group->push_back(&mesh);
  }
  for (const Group& group : groups) diagnostics.warning(group.front()->where, sentence(group));
}

}  // namespace pedicel::robot
