#include "dashpot/identify/search/search_space.h"

#include <cmath>
#include <set>

#include "dashpot/base/text.h"
#include "support.h"

using namespace dashpot;

namespace {

SearchAxis axis(const std::string& text) { return parse_search_axis(text, "--over"); }

std::vector<std::string> texts(const std::vector<NetworkDesign>& designs) {
  std::vector<std::string> result;
  for (const NetworkDesign& design : designs) result.push_back(format_design(design));
  return result;
}

}  // namespace

TEST_CASE("an axis is a list or a range, and reads back as it is written") {
  const SearchAxis list = axis("hidden=5, 10,10-10");
  CHECK(list.values == std::vector<std::string>{"5", "10", "10-10"});
  const SearchAxis range = axis("l2=1e-5:1e-2");
  CHECK(range.values.empty());
  CHECK(range.low == 1e-5);
  CHECK(range.high == 1e-2);
  CHECK(!range.whole);
  CHECK(axis("batch=16:256").whole);
  CHECK(axis("hidden=2:20").whole);
  for (const char* text :
       {"hidden=5,10,10-10", "l2=1e-05:0.01", "delays=0:4", "activation=tanh,relu"})
    CHECK(format_axis(axis(format_axis(axis(text)))) == format_axis(axis(text)));
}

TEST_CASE("what cannot be searched says why") {
  const auto message = [](const std::string& text) { return message_of([&] { axis(text); }); };
  CHECK(message("hiden=3").starts_with("--over: unknown setting 'hiden'; did you mean 'hidden'?"));
  CHECK(message("hidden").starts_with("--over: 'hidden' has no values"));
  CHECK(message("hidden=5,x").starts_with("--over hidden: is 'x'; a whole number"));
  CHECK(message("hidden=5,05").starts_with("--over hidden: '5' comes twice"));
  CHECK(message("rate=1e-2:1e-3").starts_with("--over rate: '1e-2:1e-3' is not a range"));
  CHECK(message("rate=1:2:3").starts_with("--over rate: '1:2:3' is not a range"));
  CHECK(message("rate=-1:1").starts_with("--over rate: is '-1'; a number above 0"));
  CHECK(message("l2=0:1").starts_with("--over l2: a range from 0 has no logarithm"));
  CHECK(
      message("activation=tanh:relu").starts_with("--over activation: 'tanh:relu' is not a range"));

  const auto space = [](const SearchSpace& asked, const std::string& model) {
    return message_of([&] { require_space(asked, model); });
  };
  CHECK(space({{axis("hidden=2,3")}, {}}, "mlp_one_sensor").empty());
  CHECK(space({}, "mlp_one_sensor").starts_with("--over: there is nothing to search"));
  CHECK(space({{axis("hidden=2"), axis("hidden=3")}, {}}, "mlp_one_sensor").find("comes twice") !=
        std::string::npos);
  CHECK(space({{axis("hidden=2")}, {.hidden = {4}}}, "mlp_one_sensor").find("fixed as well") !=
        std::string::npos);
  CHECK(space({{axis("activation=tanh")}, {}}, "hysteresis_network")
            .find("does not follow 'activation'") != std::string::npos);
  CHECK(space({{axis("hidden=2")}, {}}, "bingham").find("is no network") != std::string::npos);
}

TEST_CASE("what a trainer has no use for makes no trials of its own") {
  const SearchSpace space{{axis("trainer=lm,adam,bayesian"), axis("rate=0.01,0.1")},
                          {.batch = 20, .l2 = 1}};
  require_space(space, "mlp_one_sensor");
  CHECK(texts(grid_designs(space, 1)) ==
        std::vector<std::string>{"trainer=lm,l2=1", "trainer=adam,rate=0.01,batch=20,l2=1",
                                 "trainer=adam,rate=0.1,batch=20,l2=1", "trainer=bayesian"});
  CHECK(random_designs(space, 20, 1).size() == 4);
  const auto message = [](const SearchSpace& asked) {
    return message_of([&] { require_space(asked, "mlp_one_sensor"); });
  };
  CHECK(message({{axis("rate=0.01,0.1")}, {}})
            .starts_with("--over: no trainer of this search has a use for"));
  CHECK(message({{axis("hidden=2,3")}, {.batch = 20}}).starts_with("--network: no trainer"));
  CHECK(message({{axis("rate=0.01,0.1")}, {.trainer = Trainer::Adam}}).empty());
}

TEST_CASE(
    "a grid holds every combination; ranges in even ratios with both ends, whole numbers once") {
  CHECK(texts(grid_designs({{axis("hidden=2,3"), axis("l2=1e-6:1e-2")}, {.members = 2}}, 3)) ==
        std::vector<std::string>{"hidden=2,l2=1e-06,members=2", "hidden=2,l2=1e-04,members=2",
                                 "hidden=2,l2=0.01,members=2", "hidden=3,l2=1e-06,members=2",
                                 "hidden=3,l2=1e-04,members=2", "hidden=3,l2=0.01,members=2"});
  CHECK(texts(grid_designs({{axis("delays=0:4")}, {}}, 3)) ==
        std::vector<std::string>{"delays=0", "delays=2", "delays=4"});
  CHECK(texts(grid_designs({{axis("hidden=1:3")}, {}}, 10)) ==
        std::vector<std::string>{"hidden=1", "hidden=2", "hidden=3"});
  std::string many = "epochs=1";
  for (int k = 2; k <= 400; ++k) many += "," + std::to_string(k);
  const SearchSpace huge{{axis(many), axis("batch" + many.substr(6))},
                         {.trainer = Trainer::Adam}};  // 160 000
  CHECK(message_of([&] { grid_designs(huge, 1); }).find("over 100000 combinations") !=
        std::string::npos);
}

TEST_CASE(
    "designs drawn by chance differ, begin alike whatever their number, and end with the space") {
  const SearchSpace space{{axis("hidden=1:30"), axis("l2=1e-6:1e-2"), axis("activation=tanh,relu")},
                          {}};
  const std::vector<std::string> many = texts(random_designs(space, 200, 1));
  CHECK(std::set<std::string>(many.begin(), many.end()).size() == 200);
  const std::vector<std::string> few = texts(random_designs(space, 20, 1));
  CHECK(std::equal(few.begin(), few.end(), many.begin()));
  CHECK(texts(random_designs(space, 20, 2)) != few);
  CHECK(random_designs({{axis("hidden=2,3"), axis("activation=tanh,relu")}, {}}, 50, 1).size() ==
        4);
}

TEST_CASE("a range is drawn evenly in the logarithm, whole numbers from 0 evenly") {
  // Of a range over four decades, half lies below its middle, 1e-4; of 1 ... 31, half below
  // sqrt(32) = 5.7.
  int low_prices = 0, small = 0, counts[5] = {};
  const std::vector<NetworkDesign> designs = random_designs(
      {{axis("l2=1e-6:1e-2"), axis("batch=1:31"), axis("delays=0:4")}, {.trainer = Trainer::Adam}},
      2000, 3);
  for (const NetworkDesign& design : designs) {
    low_prices += *design.l2 < 1e-4;
    small += *design.batch < 6;
    ++counts[*design.delays];
    CHECK(*design.batch <= 31);
  }
  CHECK_CLOSE(low_prices, 1000, 0, 90);  // four standard deviations of a fair coin
  CHECK_CLOSE(small, 2000 * std::log(6.0) / std::log(32.0), 0, 90);
  for (const int count : counts) CHECK_CLOSE(count, 400, 0, 72);
}

TEST_CASE("seeds follow from their purpose") {
  CHECK(seed_for(1, "a") == seed_for(1, "a"));
  CHECK(seed_for(1, "a") != seed_for(2, "a"));
  CHECK(seed_for(1, "a") != seed_for(1, "b"));
  // printf '0\n' | sha256sum
  CHECK(seed_for(0, "") == 0x9a271f2a916b0b6eULL);
}
