// The C++ library from another project: identify RECORDINGS
#include <cstdio>
#include <exception>
#include <fstream>

#include "dashpot/export.h"
#include "dashpot/rank.h"

int main(int argc, char** argv) {
  try {
    // Read the recordings, identify a model, and judge it on those that it has not seen.
    const dashpot::Dataset dataset = dashpot::load_dataset({argc > 1 ? argv[1] : "."});
    const dashpot::Ranking ranking =
        dashpot::rank({"bingham"}, dataset, dashpot::default_leave_out(dataset), {.starts = 1});
    const dashpot::RankedModel& best = ranking.models.front();
    std::printf("%s: RMSE %.17g N on recordings that it has not seen\n", best.name.c_str(),
                best.left_out.pooled.rmse);

    // Let it damp a quarter car on a road.
    const dashpot::ModelFile model = dashpot::to_model_file(best, dataset, "identify");
    dashpot::save_model(model, "bingham.json");
    const dashpot::Vehicle car = dashpot::make_vehicle({.dampers = {"bingham.json"}});
    const auto road = dashpot::make_ground("iso8608,class=C,speed=72km/h", 1);
    const dashpot::Trace trace = dashpot::simulate(car.on(*road), car.options(2));
    std::printf("%zu samples of a ride\n", trace.record.size());

    // Export it as C.
    const auto files = dashpot::find_exporter("c").write(dashpot::exported_model(model), {});
    for (const dashpot::ExportedFile& file : files) std::ofstream(file.name) << file.content;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
