#include "app/cli.h"

int main(int argc, char** argv) {
  return pedicel::app::run_cli(argc, argv);
}
