#include "app/cli.h"
#include "app/window/open_desktop.h"

int main(int argc, char** argv) {
  return pedicel::app::run_cli(argc, argv, pedicel::app::open_desktop);
}
