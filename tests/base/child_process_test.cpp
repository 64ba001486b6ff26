#include "dashpot/base/child_process.h"

#include "support.h"

using dashpot::run_child;

TEST_CASE("a child's output, both streams, and whether it succeeded") {
  const dashpot::ChildResult fine =
      run_child({"sh", "-c", "echo one; echo \"$0\" >&2", "two words"});
  CHECK(fine.succeeded);
  CHECK(fine.printed == "one\ntwo words\n");
  CHECK(!run_child({"sh", "-c", "exit 3"}).succeeded);
  CHECK(!run_child({"sh", "-c", "kill -9 $$"}).succeeded);
}

TEST_CASE("a program that is not there is an error with its name") {
  CHECK(message_of([] { run_child({"no-such-program"}); }).starts_with("no-such-program: "));
}
