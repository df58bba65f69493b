#include "app/help/manual.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "app/help/key_tables.h"
#include "app/help/manual_rows.h"
#include "app/report/manual.h"
#include "engine/core/exit_code.h"
#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

struct ManualArguments {
  std::string page = "index";
  std::string folder;  // of pages to be rewritten; empty: none
  bool text = false, pages = false, rows = false;
};

int rewrite(const std::filesystem::path& folder) {
  for (const std::string& page : pages_of_keys()) {
    const std::filesystem::path file = folder / (page + ".md");
    const std::string before = io::read_file(file), after = with_key_tables(page, before);
    if (after == before) continue;
    io::write_file_atomically(file, after);
    std::cout << file.string() << " changed" << std::endl;
  }
  return exit_ok;
}

int run(const ManualArguments& a) {
  if (!a.folder.empty()) return rewrite(a.folder);
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
  verb->add_option(
      "--rewrite", a->folder,
      "write the tables of keys into the pages of this folder as the program describes "
      "them");
  return [a] { return run(*a); };
}

}  // namespace pedicel::app
