#include "app/commands/commands.h"

int main(int argc, char** argv) {
  return clatter::run_program(argc, argv);
}
