#include "pedicel/app/help/manual.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "pedicel/app/help/manual_rows.h"
#include "pedicel/app/report/manual.h"
#include "pedicel/core/exit_code.h"

namespace pedicel::app {

namespace {

struct ManualArguments {
  std::string page = "index";
  bool text = false, pages = false, rows = false;
};

int run(const ManualArguments& a) {
  if (a.rows) {
    for (const ManualRow& row : manual_rows()) {
      std::cout << row.page << '\t' << row.keys << "\t|";
      for (const std::string& cell : row.cells)
        std::cout << ' ' << cell << (cell.empty() ? "|" : " |");
      std::cout << '\n';
    }
    return exit_ok;
  }
  if (a.pages) {
    for (const std::string& page : manual_pages()) std::cout << page << '\n';
    return exit_ok;
  }
  const std::string text = manual_text(a.page);
  const std::filesystem::path html = manual_html(a.page);
  if (!a.text && !html.empty() && open_in_browser(html))
    std::cout << "opened " << html.string() << std::endl;
  else
    std::cout << text << std::flush;
  return exit_ok;
}

}  // namespace

std::function<int()> add_manual_verb(CLI::App& app) {
  const auto a = std::make_shared<ManualArguments>();
  CLI::App* verb = app.add_subcommand(
      "manual", "open the manual in a browser, or print a page of it where there is none");
  verb->add_option("page", a->page, "page to open (default: index)");
  verb->add_flag("--text", a->text, "print the page, though there is a browser");
  verb->add_flag("--pages", a->pages, "print the names of all pages");
  verb->add_flag(
      "--rows", a->rows,
      "print the rows of the reference tables that come from the program's descriptions");
  return [a] { return run(*a); };
}

}  // namespace pedicel::app
