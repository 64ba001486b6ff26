#include <cstdio>

#include "fuzz.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: fuzz_seeds FOLDER\n", stderr), 2;
  write_seeds(argv[1]);
  for (const FuzzTarget* target : fuzz_targets())
    std::printf("%s\n", std::string(target->name()).c_str());
}
