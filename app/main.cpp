#include "app/commands/commands.h"
#include "engine/system/signals.h"
#include "engine/system/terminal.h"

int main(int argc, char** argv) {
  clatter::open_standard_streams();
  clatter::refuse_large_files();
  return clatter::run_program(argc, argv);
}
