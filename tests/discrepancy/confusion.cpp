#include <algorithm>
#include <map>

#include "tests/discrepancy/score_table.h"

namespace pedicel::hidden {

namespace {

std::string joined(const std::vector<std::string>& names, const char* between) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : between) + name;
  return text;
}

std::string hidden_label(const Score& s) {
  if (s.kind == "null") return "nothing";
  if (s.kind == "look_alike") return s.hidden.front() + " (looks like others)";
  return joined(s.hidden, " + ");
}

std::string said_label(const Score& s) {
  if (!s.fault.empty()) return "no verdict";
  if (s.outcome == "adequate") return "nothing";
  if (s.outcome == "ambiguous")
    return s.call == Call::not_held || s.kind == "null" ? "cannot tell, not among them"
                                                        : "cannot tell, among them";
  if (s.outcome == "named") return joined(s.said, " + ");
  return s.outcome;
}

// Names in their order, what is no name behind them.
int rank_of(const std::string& label) {
  static const std::vector<std::string> last = {"nothing",
                                                "cannot tell, among them",
                                                "cannot tell, not among them",
                                                "unknown",
                                                "bad_data",
                                                "numerical",
                                                "no verdict"};
  const auto found = std::ranges::find(last, label);
  if (found != last.end()) return 10 + static_cast<int>(found - last.begin());
  return label.find(' ') == std::string::npos ? 0 : label.find('+') == std::string::npos ? 2 : 1;
}

std::vector<std::string> sorted(const std::map<std::string, int>& labels) {
  std::vector<std::string> list;
  for (const auto& [label, count] : labels) list.push_back(label);
  std::ranges::stable_sort(list, {}, rank_of);
  return list;
}

}  // namespace

Confusion confusion(const std::vector<Score>& scores) {
  std::map<std::string, int> rows, columns;
  for (const Score& s : scores) {
    ++rows[hidden_label(s)];
    ++columns[said_label(s)];
  }
  Confusion result{sorted(rows), sorted(columns), {}};
  for (std::size_t i = 0; i < result.hidden.size(); ++i)
    rows[result.hidden[i]] = static_cast<int>(i);
  for (std::size_t i = 0; i < result.said.size(); ++i)
    columns[result.said[i]] = static_cast<int>(i);
  result.count.assign(result.hidden.size(), std::vector<int>(result.said.size(), 0));
  for (const Score& s : scores) ++result.count[rows[hidden_label(s)]][columns[said_label(s)]];
  return result;
}

std::string markdown(const Confusion& confusion) {
  std::string text = "| hidden | said (cases) |\n|---|---|\n";
  for (std::size_t r = 0; r < confusion.hidden.size(); ++r) {
    std::vector<std::pair<int, std::string>> said;
    for (std::size_t c = 0; c < confusion.said.size(); ++c)
      if (confusion.count[r][c] > 0) said.emplace_back(confusion.count[r][c], confusion.said[c]);
    std::ranges::stable_sort(said, [](const auto& a, const auto& b) { return a.first > b.first; });
    text += "| " + confusion.hidden[r] + " | ";
    for (std::size_t i = 0; i < said.size(); ++i)
      text += (i ? ", " : "") + said[i].second + " " + std::to_string(said[i].first);
    text += " |\n";
  }
  return text;
}

std::string csv(const Confusion& confusion) {
  std::string text = "hidden";
  for (const std::string& label : confusion.said) text += ",\"" + label + "\"";
  text += "\n";
  for (std::size_t r = 0; r < confusion.hidden.size(); ++r) {
    text += "\"" + confusion.hidden[r] + "\"";
    for (const int count : confusion.count[r]) text += "," + std::to_string(count);
    text += "\n";
  }
  return text;
}

}  // namespace pedicel::hidden
