// The C++ library from another project: identify RECORDINGS
#include "dashpot/identify.h"

#include <cstdio>
#include <exception>

#include "dashpot/dataset.h"
#include "dashpot/rank.h"
#include "dashpot/split.h"

int main(int argc, char** argv) {
  try {
    const dashpot::Dataset dataset = dashpot::load_dataset({argc > 1 ? argv[1] : "."});
    const dashpot::Ranking ranking =
        dashpot::rank({"bingham"}, dataset, dashpot::default_leave_out(dataset), {.starts = 1});
    const dashpot::RankedModel& best = ranking.models.front();
    std::printf("%s: RMSE %.17g N on recordings that it has not seen\n", best.name.c_str(),
                best.left_out.pooled.rmse);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
