#include "dashpot/report/page.h"
#include "dashpot/report/report_json.h"
#include "dashpot/report/safe_text.h"
#include "dashpot/report/words.h"

namespace dashpot {

std::string html_report(const ReportInput& input) {
  Value data = json_report(input);
  data.add("page", "report");
  data.add("series", presentable(series_json(input.ranking)));
  data.add("residuals", presentable(residuals_json(input.ranking)));
  return make_page(input.dataset.name + ", Dashpot report",
                   verdict(input.ranking) + "\n\n" + ranking_table(input.ranking, 100), data);
}

}  // namespace dashpot
