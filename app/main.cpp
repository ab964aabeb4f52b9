#include "app/commands/commands.h"
#include "app/system/standard_streams.h"

int main(int argc, char** argv) {
  clatter::open_standard_streams();
  return clatter::run_program(argc, argv);
}
