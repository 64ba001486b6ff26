#include "dashpot/report/report.h"

#include <algorithm>
#include <cstdlib>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/mean/mean_model.h"
#include "dashpot/report/gnuplot.h"
#include "dashpot/report/inspection.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/ranking_tables.h"
#include "dashpot/report/ranking_words.h"
#include "report/example_ranking.h"
#include "support.h"

using namespace dashpot;

namespace {

const Value& at(const Value& value, const std::string& path) {
  const Value* here = &value;
  for (const std::string& key : split(path, '.')) {
    const auto index = parse_number(key);
    here = index ? &here->items().at(static_cast<std::size_t>(*index)) : here->find(key);
    REQUIRE(here);
  }
  return *here;
}

/// The data that a page carries.
Value page_data(const std::string& html) {
  const std::string start = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = html.find(start) + start.size();
  return parse_json(html.substr(from, html.find("</script>", from) - from), "page");
}

/// Samples of a packed series of float32: three bytes in four letters.
double unpacked_size(const Value& packed) {
  const std::string& base64 = at(packed, "float32").as_string();
  const auto padding = static_cast<std::size_t>(std::ranges::count(base64, '='));
  return static_cast<double>(base64.size() / 4 * 3 - padding) / sizeof(float);
}

}  // namespace

TEST_CASE("JSON report: every figure under its name, what is not a number as null") {
  const ExampleRanking example = example_ranking();
  const Value report = parse_json(format_json(json_report(example.input())), "report");
  CHECK(at(report, "format").as_string() == "dashpot report 1");
  CHECK(at(report, "models").items().size() == 3);
  const Metrics& pooled = example.ranking.models[0].left_out.pooled;
  CHECK(at(report, "models.0.left_out.pooled.esr_percent").as_number() == pooled.esr);
  CHECK(at(report, "models.0.left_out.records.3.offset_N").as_number() == 20);
  CHECK(at(report, "models.0.fold_fits.1.fold").as_string() == "without 10 mm 1 Hz");
  CHECK(at(report, "models.2.left_out.records.11.metrics.esr_percent").is_null());
  CHECK(at(report, "models.2.left_out.records.11.diverged_at").as_number() == 1.5);
  const Coverage& coverage = example.ranking.models[0].left_out.coverage;
  CHECK(at(report, "models.0.left_out.interval.coverage_percent").as_number() ==
        coverage.percent());
  CHECK(at(report, "models.0.left_out.interval.mean_width_N").as_number() == 120);
  CHECK(at(report, "models.0.left_out.interval.level_percent").as_number() == 90);
  CHECK(at(report, "models.0.left_out.records.3.band.half_width_N.0").as_number() == 60);
  CHECK(contains(markdown_document(ranking_document(example.input())),
                 "| Model | Covered % | Worst % |"));
  CHECK(at(report, "dataset.files.0.sha256").as_string() == std::string(64, 'a'));
}

TEST_CASE("HTML report: one file that asks for nothing and cannot be broken by a name") {
  ExampleRanking example = example_ranking();
  const std::string name = "</script><script>alert(1)</script>\xE4";
  example.dataset.name = name;
  for (RankedModel& model : example.ranking.models)
    model.left_out.records[0].record = model.training.records[0].record = name;
  const std::string html = html_document(ranking_document(example.input()));
  CHECK(!contains(html, "<script>alert"));
  CHECK(contains(html, "default-src 'none'"));
  for (const char* request : {" src=", "<link", "@import", "url(", "fetch(", "{{"}) {
    CAPTURE(request);
    CHECK(!contains(html, request));
  }
  const Value data = page_data(html);
  const auto& records = at(data, "sections.1.choices.1.options").items();
  CHECK(records.front().as_string() == "</script><script>alert(1)</script>\xEF\xBF\xBD");
  CHECK(records.size() == 12);
  CHECK(unpacked_size(at(data, "samples.0")) == 1500);
}

TEST_CASE("HTML report: long records are thinned, figures are not" * doctest::test_suite("long")) {
  const ExampleRanking example = example_ranking(20000);
  const std::string html = html_document(ranking_document(example.input()));
  CHECK(html.size() < 6e6);
  const Value data = page_data(html);
  CHECK(unpacked_size(at(data, "samples.0")) < 20000);
  CHECK(contains(html, "12 of 12 records are thinned"));
  CHECK(at(json_report(example.input()), "models.0.left_out.pooled.samples").as_number() ==
        12 * 18000);
}

TEST_CASE("reports of nothing") {
  const Dataset dataset{.name = "empty"};
  const Ranking ranking;
  const ReportInput input{dataset, ranking, "", "", ""};
  CHECK(contains(html_document(ranking_document(input)), "No model was tried"));
  CHECK(contains(markdown_document(ranking_document(input)), "No model was tried"));
  CHECK(split(csv_report(input), '\n').size() == 2);
  CHECK(message_of([&] { write_figures(input, "."); }) ==
        "figures: no model was judged on any record");
}

TEST_CASE("verdict: the winner, its worst record, the next, and who diverged") {
  ExampleRanking example = example_ranking();
  auto& models = example.ranking.models;
  models[0].left_out.pooled.esr = 2;
  models[0].left_out.pooled.rmse = 41.26;
  models[0].left_out.worst_esr = 7.123;
  models[1].left_out.pooled.esr = 3.63;
  CHECK(in_units(verdict(example.ranking), {}) ==
        "Modified Bouc-Wen (Spencer) predicts the force best: on recordings that it has not seen "
        "it leaves "
        "2.0 % of "
        "the force's power unexplained, an RMS error of 41.3 N; its worst record is 10 mm 1 Hz 0 A "
        "with 7.1 "
        "%. Next "
        "comes Hyperbolic tangent (Kwok) with 3.6 %. 1 model diverged.");
  models.erase(models.begin(), models.begin() + 2);
  CHECK(contains(verdict(example.ranking), "No model can be used"));
}

TEST_CASE("verdict: no winner is named where the data name none") {
  ExampleRanking example = example_ranking();
  auto& models = example.ranking.models;
  models[0].left_out.pooled.esr = 2;
  models[1].left_out.pooled.esr = 2.1;
  models[1].over_first = PairedRatio{.times = 1.1, .low = 0.8, .high = 1.5, .units = 4};
  REQUIRE(example.ranking.leaders().size() == 2);
  const std::string tied = verdict(example.ranking);
  CAPTURE(tied);
  CHECK(tied.starts_with(
      "Modified Bouc-Wen (Spencer) and Hyperbolic tangent (Kwok) cannot be told apart on these "
      "recordings. Modified Bouc-Wen (Spencer) has the smallest error: on recordings that it has "
      "not seen it leaves 2.0 % of the force's power unexplained"));
  CHECK(!contains(tied, "best"));
  CHECK(contains(comparison_note(example.ranking).value_or(""), "over 4 divisions"));

  // A model without an interval cannot be told apart either.
  models[1].over_first.reset();
  CHECK(example.ranking.leaders().size() == 2);

  // With one model there is nothing to be best of; with one usable model, nothing beside it.
  models.erase(models.begin() + 1);
  CHECK(contains(verdict(example.ranking), "(Spencer) is the only model that can be used: on"));
  models.pop_back();
  CHECK(verdict(example.ranking)
            .starts_with("Modified Bouc-Wen (Spencer): on recordings that it has not seen it"));
  CHECK(!comparison_note(example.ranking));

  // Parts of recordings are said to be parts.
  example.ranking.leave_out.by = LeaveOut::By::Blocks;
  CHECK(contains(verdict(example.ranking), "on parts of the recordings that it has not seen it"));
}

TEST_CASE("verdict: a model that does not forget is not recommended, however small its error") {
  ExampleRanking example = example_ranking();
  auto& models = example.ranking.models;
  models[0].left_out.pooled.esr = 2;
  std::swap(models[0], models[1]);  // as rank() has them: those that do not forget come last
  models[1].forgetting.share_left = 0.07;
  models[0].over_first.reset();
  models[0].left_out.pooled.esr = 3;
  REQUIRE(example.ranking.leaders().size() == 1);
  const std::string said = verdict(example.ranking);
  CAPTURE(said);
  CHECK(said.starts_with("Hyperbolic tangent (Kwok) is the only model that can be used"));
  CHECK(contains(said,
                 "Modified Bouc-Wen (Spencer) does not forget how it began and is not "
                 "recommended, in spite of 2.0 %."));
  const DocumentTable table = ranking_document(example.input()).sections.front().tables.front();
  CHECK(table.rows[1].back() == "remembers");
  CHECK(table.warnings[1]);
  models[0].forgetting.share_left = 0.02;
  CHECK(contains(verdict(example.ranking), "No model can be recommended"));
}

TEST_CASE("verdict: a model that feeds energy in is not recommended, and says where") {
  ExampleRanking example = example_ranking();
  auto& models = example.ranking.models;
  std::swap(models[0], models[1]);  // as rank() has them: those that feed energy in come last
  models[0].over_first.reset();
  models[0].left_out.pooled.esr = 3;
  models[1].left_out.pooled.esr = 2;
  models[1].dissipation = {.is_tested = true,
                           .frequency = 75,
                           .amplitude = 1e-5,
                           .drive = 1,
                           .damping = -4000,
                           .share = -0.8,
                           .active_from = 40,
                           .active_to = 200};
  const std::string said = verdict(example.ranking);
  CAPTURE(said);
  CHECK(contains(said,
                 "Modified Bouc-Wen (Spencer) feeds energy into some motions and is not "
                 "recommended, in spite of 2.0 %."));
  const Document document = ranking_document(example.input());
  const DocumentTable& table = document.sections.front().tables.front();
  CHECK(table.rows[1].back() == "feeds energy");
  CHECK(std::ranges::find(table.rows[1], "no, 40 to 200 Hz") != table.rows[1].end());
  CHECK(table.warnings[1]);
  CHECK(at(json_report(example.input()), "models.1.dissipation.dissipates").as_bool() == false);
  CHECK(at(json_report(example.input()), "models.1.dissipation.damping_N_s_per_m").as_number() ==
        -4000);
}

TEST_CASE("verdict of a model fitted elsewhere: whether its fit has seen the recordings") {
  ExampleRanking example = example_ranking();
  auto& ranking = example.ranking;
  ranking.models.resize(1);
  ranking.seen = 0;
  CHECK(contains(verdict(ranking), "on recordings that it has not seen"));
  ranking.seen = 5;
  CHECK(contains(verdict(ranking), "on 12 recordings, of which its fit has seen 5,"));
  ranking.seen = 12;
  CHECK(contains(verdict(ranking), "on the recordings that it was fitted on"));
  CHECK(!contains(verdict(ranking), "not seen"));
  CHECK(contains(protocol(ranking), "its fit has seen 12 of 12 records"));
  CHECK(protocol_title(ranking) == "a model fitted elsewhere");
}

TEST_CASE("the one-step note names models that feed force back, or says that there are none") {
  ExampleRanking example = example_ranking();
  CHECK(contains(one_step_note(example.ranking).value_or(""),
                 "none of these models feeds force back"));
  example.ranking.models[0].left_out.one_step.emplace().esr = 0.123;
  example.ranking.models[0].left_out.pooled.esr = 3.5;
  CHECK(contains(one_step_note(example.ranking).value_or(""),
                 example.ranking.models[0].name + " 0.12 % (free run 3.5 %)"));
  example.ranking.models[0].left_out.one_step.reset();
  example.ranking.models[1].fit.model.reset();
  CHECK(!one_step_note(example.ranking));
}

TEST_CASE("ranking table: best first, within the terminal") {
  const ExampleRanking example = example_ranking();
  for (const int width : {80, 100, 160}) {
    const DocumentTable whole =
        in_units(ranking_document(example.input())).sections.front().tables.front();
    const std::string table = text_table(whole.columns, whole.rows, width);
    CAPTURE(table);
    const auto lines = split(table, '\n');
    for (const std::string& line : lines) CHECK(line.size() <= static_cast<std::size_t>(width));
    CHECK(contains(table, "ESR"));

    // Titles take one line or more, above a rule.
    const auto rule = std::ranges::find_if(
        lines, [](const std::string& line) { return line.starts_with("----"); });
    REQUIRE(lines.end() - rule == 5);
    CHECK(contains(rule[1], "modified_bouc_wen"));
    CHECK(contains(rule[3], "1 diverged"));
  }
  CHECK(contains(document_text(ranking_document(example.input()), 160), "Worst record"));
}

TEST_CASE("parameter table: value, interval, unit, remark") {
  const DocumentTable whole = parameter_table(example_ranking().ranking.models[0].fit);
  const std::string table = text_table(whole.columns, whole.rows, 120);
  CAPTURE(table);
  CHECK(contains(table, "[871.2, 910.8]"));
  CHECK(contains(table, "N*s/m"));
  CHECK(contains(table, "weakly determined"));
  CHECK(contains(table, "fixed"));
}

TEST_CASE("a mean says what it is made of, and a terminal the numbers of its best member") {
  ExampleRanking example = example_ranking(300);
  std::vector<RankedModel>& models = example.ranking.models;
  RankedModel mean = models[0];
  mean.name = "mean";
  mean.fit.parameters.clear();
  mean.fit.model = std::make_shared<MeanModel>(
      std::vector<MeanModel::Member>{{models[1].fit.model, 0.25}, {models[0].fit.model, 0.75}});
  models.insert(models.begin(), std::move(mean));

  const Document document = ranking_document(example.input());
  const std::string text = document_text(document, 160), page = markdown_document(document);
  CHECK(contains(text, "modified_bouc_wen    0.75\n"));
  CHECK(contains(page, "| tanh\\_kwok | 0.25 |"));
  CHECK(contains(text, "Parameters of Modified Bouc-Wen (Spencer), with 95 % intervals"));
  CHECK(!contains(text, "Parameters of Hyperbolic tangent"));
  const auto first = page.find("Parameters of Modified");
  REQUIRE(first != std::string::npos);
  CHECK(page.find("Parameters of Modified", first + 1) == std::string::npos);
}

TEST_CASE("Markdown and CSV hold the same figures") {
  ExampleRanking example = example_ranking();
  example.dataset.records.clear();
  const std::string markdown = markdown_document(ranking_document(example.input()));
  CHECK(contains(markdown, "| modified\\_bouc\\_wen |"));
  CHECK(contains(markdown, "| 1 diverged |"));
  CHECK(contains(markdown, "Made by `dashpot identify demo"));

  example.ranking.models[0].left_out.records[0].record = "10 mm, \"fast\"";
  const auto lines = split(csv_report(example.input()), '\n');
  CHECK(lines.size() ==
        1 + 3 * 24 + 1);  // head, 12 left-out and 12 training records per model, end
  CHECK(contains(lines[0], "model,record,condition,drive_A,left_out,samples,rmse_N"));
  CHECK(lines[1].starts_with("modified_bouc_wen,\"10 mm, \"\"fast\"\"\",5 mm 3 Hz,0,yes,1350,"));
  const Metrics& second = example.ranking.models[0].left_out.records[1].metrics;
  CHECK(parse_number(split(lines[2], ',')[10]) == second.esr);
}

TEST_CASE("figures: SVG and PDF of the ranking, loops and trace, with their scripts") {
  const TemporaryFolder folder;
  ExampleRanking example = example_ranking();
  example.ranking.models[0].title = "O'Neill's_{model}";
  const auto paths = write_figures(example.input(), folder.path() / "a folder's figures");
  REQUIRE(paths.size() == 8);
  for (const auto& path : paths) {
    const std::string content = read_file(path);
    CHECK((path.extension() == ".svg" ? contains(content, "</svg>") : content.starts_with("%PDF")));
    CHECK(std::filesystem::exists(std::filesystem::path(path).replace_extension(".gp")));
  }
  CHECK(contains(read_file(paths[0]), "_{model}"));
}

TEST_CASE("a ring is drawn as a point, not as a line from it to nowhere") {
  const TemporaryFolder folder;
  Document document;
  FigureSeries ring{.label = "odd", .colour = "series-2", .x = {1}, .y = {2}};
  ring.mark = FigureSeries::Mark::Rings;
  document.sections.push_back({.name = "one", .title = "One"});
  document.sections.back().figures.push_back({"rings", "Rings", "", {{"", "x", "y", {ring}}}, 1});
  const auto paths = write_document_figures(document, folder.path());
  REQUIRE(!paths.empty());
  const std::string script =
      read_file(std::filesystem::path(paths.front()).replace_extension(".gp"));
  CHECK_MESSAGE(contains(script, "with points pt 6"), script);
}

TEST_CASE("gnuplot's complaint and its absence are errors") {
  const TemporaryFolder folder;
  GnuplotFigure figure(8, 6);
  figure.command("plot no_such_function(x)");
  CHECK(contains(message_of([&] { figure.write(folder.path(), "bad"); }), "undefined function"));

  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  const std::string message = message_of([&] { figure.write(folder.path(), "bad"); });
  setenv("PATH", path.c_str(), 1);
  CHECK(contains(message, "install gnuplot-nox"));
}

TEST_CASE("inspection: channels of every record, and both velocities") {
  const Dataset dataset = example_ranking().dataset;
  const Document document =
      inspection_document({dataset, {}, "dashpot inspect demo", "0.1.0", "2026-11-21"});
  const DocumentTable& records = document.sections[0].tables[0];
  CHECK(records.rows.size() == 12);
  CHECK(records.keys[2][2] == 1.6);
  CHECK_CLOSE(records.keys[0][7], 0.005, 1e-3, 0);
  const FigurePanel& velocity = document.sections[1].figures[0].panels[1];
  CHECK(velocity.series.size() == 24);
  CHECK(contains(velocity.series[5].label, "derived from displacement"));
  CHECK(at(document.data, "columns.0.channel").as_string() == "displacement");
  CHECK(contains(html_document(document), "Force against velocity"));
}

TEST_CASE("inspection: files whose columns were understood alike stand once on the page") {
  Dataset dataset = example_ranking().dataset;
  dataset.readings.clear();
  for (const char* file : {"a/run_1.csv", "a/run_2.csv", "a/run_3.csv", "a/other.csv"})
    for (const char* column : {"x [mm]", "F [N]"})
      dataset.readings.push_back(
          {.file = file,
           .column = column,
           .channel = column[0] == 'x' ? "displacement" : "force",
           .basis = file == std::string("a/other.csv") ? "stated" : "header"});
  const Document document = inspection_document({dataset, {}, "dashpot inspect demo", "", ""});
  const DocumentTable& columns = document.sections[2].tables[0];
  REQUIRE(columns.rows.size() == 4);
  CHECK(columns.rows[1][0] == "run_1.csv and 2 more like it");
  CHECK(columns.rows[2][0] == "other.csv");
  CHECK(at(document.data, "columns.7.file").as_string() == "a/other.csv");
}

TEST_CASE("a document without data gives programs its words and tables") {
  Document document{.title = "two", .subtitle = {}, .verdict = "both", .sections = {}};
  document.sections.push_back({.name = "one",
                               .title = "One",
                               .paragraphs = {"words"},
                               .tables = {{"numbers", {{"a"}, {"b", true}}, {{"x", "1"}}}}});
  const Value json = document_json(document);
  CHECK(at(json, "verdict").as_string() == "both");
  CHECK(at(json, "sections.0.tables.0.rows.0.1").as_string() == "1");
  document.data = Value::object({{"own", 3}});
  CHECK(at(document_json(document), "own").as_number() == 3);
}

TEST_CASE("what depends on a choice: text opens with the first, Markdown has every option") {
  Document document{.title = "two", .subtitle = {}, .verdict = "both", .sections = {}};
  DocumentSection section{.name = "one", .title = "One", .paragraphs = {}};
  section.choices = {{"model", "Model", {"first", "second"}, 1}};
  for (const std::size_t k : {0, 1}) {
    section.tables.push_back({"", {{"a"}}, {{"of model " + std::to_string(k)}}});
    section.tables.back().when = {{"model", {k}}};
  }
  document.sections.push_back(section);
  const std::string text = document_text(document, 80), page = markdown_document(document);
  CHECK(contains(text, "of model 1"));
  CHECK(!contains(text, "of model 0"));
  CHECK(contains(page, "### first\n\n| a |\n|---|\n| of model 0 |"));
  CHECK(contains(page, "### second\n"));
}
