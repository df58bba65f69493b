// hidden_case --list | --seed S --case N [--case M ...] --out DIR
// Writes DIR/case_N, an experiment folder with something hidden in it, and the truth beside it.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "engine/io/atomic_file.h"
#include "tests/discrepancy/hidden_case.h"

namespace {

using namespace pedicel::hidden;

std::string words(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& word : list) text += (text.empty() ? "" : "+") + word;
  return text.empty() ? "-" : text;
}

void print_orders() {
  std::printf("%4s %-10s %-12s %-8s %5s %-8s %-4s %s\n", "case", "kind", "plant", "pack", "size",
              "noise", "off", "hidden");
  for (const CaseOrder& o : case_orders())
    std::printf("%4d %-10s %-12s %-8s %5g %-8s %-4s %s\n", o.number, name_of(o.kind),
                name_of(o.plant), name_of(o.pack), o.size, o.coloured ? "coloured" : "white",
                o.off ? "yes" : "no", words(o.hidden).c_str());
}

void print_case(const HiddenCase& c) {
  std::printf("%s %s %s/%s %s sine %.3f noise %.3g m %.3g N rho %.2f", c.name.c_str(),
              words(c.order.hidden).c_str(), name_of(c.order.plant), name_of(c.order.pack),
              name_of(c.expected), c.sine, c.noise.position_std, c.noise.force_std, c.noise.rho);
  for (std::size_t i = 0; i < c.size.size(); ++i)
    std::printf(" | smallest %.4g, size %.4g, seen %.3g", c.smallest[i], c.size[i], c.visible[i]);
  if (c.nearest.distance > 0.0)
    std::printf(" | nearest %s %.3g", c.nearest.cause.c_str(), c.nearest.distance);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Writes experiment folders with a hidden effect."};
  std::uint64_t seed = 1;
  std::vector<int> cases;
  std::string out;
  bool list = false;
  const int most = static_cast<int>(case_orders().size()) - 1;
  app.add_option("--seed", seed, "what the details are drawn from")->capture_default_str();
  app.add_option("--case", cases, "numbers of --list")->check(CLI::Range(0, most));
  app.add_option("--out", out, "folder; without it the case is only made");
  app.add_flag("--list", list, "print all cases");
  CLI11_PARSE(app, argc, argv);
  if (list) print_orders();
  try {
    for (const int number : cases) {
      HiddenCase c = make_case(seed, case_orders()[number]);
      print_case(c);
      if (!out.empty()) write_case(out, c);
    }
  } catch (const pedicel::io::WriteError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 6;
  }
  return 0;
}
