#include "app/verbs/cli.h"
#include "app/window/open_desktop.h"

int main(int argc, char** argv) {
  using namespace pedicel::app;
  return run_cli(argc, argv, open_desktop, make_films);
}
