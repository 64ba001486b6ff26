#include "dashpot/machine/in_plant_words.h"

#include "dashpot/machine/plant_recording.h"
#include "support.h"

using namespace dashpot;

namespace {

const std::string kCar =
    "plant: quarter_car\n"
    "parameters:\n"
    "  sprung_mass: {about: 350 kg, from: 300 kg, to: 0.5 t}\n"
    "  unsprung_mass: 40 kg\n"
    "  spring_stiffness: 20 N/mm\n"
    "  tyre_stiffness: unknown\n"
    "inputs:\n"
    "  - {channel: road, kind: ground}\n"
    "sensors:\n"
    "  - {channel: body, quantity: acceleration, at: body, noise: 0.1, delay: unknown}\n"
    "  - {channel: level, quantity: deflection, noise: 0.2 mm, delay: 2 ms, filter: 30 Hz}\n"
    "current: coil\n"
    "start: rest\n"
    "held_back: 0.3\n"
    "skip: 500 ms\n";

std::string refused(const std::string& text) {
  return message_of([&] { parse_in_plant_setup(text, "car.yaml"); });
}

/// kCar with one text in place of another.
std::string with(const std::string& old, const std::string& other) {
  std::string text = kCar;
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), other);
}

}  // namespace

TEST_CASE("a plant's file: numbers in any unit, ranges, sensors and what drives the damper") {
  const InPlantSetup setup = parse_in_plant_setup(kCar, "car.yaml");
  CHECK(setup.model->name == "quarter_car");
  REQUIRE(setup.unknown.size() == 2);
  CHECK(setup.unknown[0].about == 350);
  CHECK(setup.unknown[0].lower == 300);
  CHECK(setup.unknown[0].upper == 500);
  CHECK_FALSE(setup.unknown[1].about);
  CHECK(setup.known[1] == std::pair<std::string, double>{"spring_stiffness", 20000});
  CHECK(setup.inputs[0].place.kind == PlantInput::Ground);
  REQUIRE(setup.sensors.size() == 2);
  CHECK(setup.sensors[0].finds_delay);
  CHECK(setup.sensors[1].place.quantity == PlantQuantity::Deflection);
  CHECK_CLOSE(setup.sensors[1].noise, 2e-4, 1e-12, 0);
  CHECK(setup.sensors[1].delay == 0.002);
  CHECK(setup.sensors[0].filter == SensorFilter{});
  CHECK(setup.sensors[1].filter == SensorFilter{30, 2});
  CHECK(parse_in_plant_setup(with("30 Hz", "{cutoff: 0.1 kHz, order: 5}"), "car.yaml")
            .sensors[1]
            .filter == SensorFilter{100, 5});
  const std::string written = format_json(to_json(setup));
  CHECK(parse_in_plant_setup(written, "written").sensors[1].filter == SensorFilter{30, 2});
  CHECK_FALSE(setup.sensors[1].finds_cutoff);
  CHECK(setup.drive_of(0).channel == "coil");
  CHECK(setup.drive_unit == DriveUnit::Ampere);
  CHECK(setup.from_rest);
  CHECK(setup.held_back == 0.3);
  CHECK(setup.skip == 0.5);
  CHECK(setup.channels() == std::vector<std::string>{"road", "body", "level", "coil"});
}

TEST_CASE("a plant's file: a filter whose cut-off is unknown, as every other unknown number") {
  struct Known {
    std::string text;
    double lower, upper, about;
    int order;
  };
  for (const Known& known : std::initializer_list<Known>{
           {"unknown", 0, INFINITY, 0, 2},
           {"20..60 Hz", 20, 60, 0, 2},
           {"{about: 30 Hz}", 0, INFINITY, 30, 2},
           {"{from: 20 Hz, to: 0.1 kHz}", 20, 100, 0, 2},
           {"{cutoff: unknown, order: 4}", 0, INFINITY, 0, 4},
           {"{cutoff: 20..60 Hz, order: 1}", 20, 60, 0, 1},
           {"{cutoff: {about: 30 Hz, from: 20 Hz}, order: 3}", 20, INFINITY, 30, 3}}) {
    INFO(known.text);
    const InPlantSetup setup = parse_in_plant_setup(with("30 Hz", known.text), "car.yaml");
    const std::string written = format_json(to_json(setup));
    for (const InPlantSetup& one : {setup, parse_in_plant_setup(written, "written")}) {
      const PlantSensor& sensor = one.sensors[1];
      REQUIRE(sensor.finds_cutoff);
      CHECK(sensor.finds_cutoff->lower == known.lower);
      CHECK(sensor.finds_cutoff->upper == known.upper);
      CHECK(sensor.filter == SensorFilter{known.about, known.order});
    }
  }
  CHECK(contains(refused(with("30 Hz", "60..20 Hz")), "filter: its range is none"));
  CHECK(contains(refused(with("30 Hz", "{about: 30 Hz, to: 20 Hz}")), "'about' lies outside"));
  CHECK(contains(refused(with("30 Hz", "{about: 30 Hz, order: 4}")), "order"));
}

TEST_CASE("a plant's file: what is wrong is named with what would be right") {
  CHECK(contains(refused(with("quarter_car", "quartercar")), "did you mean 'quarter_car'"));
  CHECK(contains(refused(with("  unsprung_mass: 40 kg\n", "")),
                 "says nothing of unsprung_mass (wheel and axle); its value in kg, or 'unknown'"));
  CHECK(contains(refused(with("  unsprung_mass: 40 kg\n  spring_stiffness: 20 N/mm\n", "")),
                 "says nothing of unsprung_mass (wheel and axle), spring_stiffness (of the "
                 "suspension); their values in kg, N/m, or 'unknown'"));
  CHECK(contains(refused(with("current: coil", "current: 1 V")),
                 "'1 V' is a level in V, not in A; 'voltage: 1 V'"));
  CHECK(contains(refused(with("40 kg", "40 m")),
                 "car.yaml:4, unsprung_mass: 'm' is not a unit of it; it is counted in kg"));
  CHECK(contains(refused(with("40 kg", "-1 kg")), "between"));
  CHECK(contains(refused(with("to: 0.5 t", "to: 200 kg")), "its range 300 ... 200 is none"));
  CHECK(contains(refused(with("about: 350 kg", "about: 600 kg")), "'about' lies outside"));
  CHECK(contains(refused(with("about:", "abuot:")), "abuot"));
  CHECK(contains(refused(with("kind: ground", "kind: road")), "unknown kind of input 'road'"));
  CHECK(contains(refused(with("at: body", "at: roof")), "no coordinate 'roof'"));
  CHECK(contains(refused(with(", at: body", "")), "says not where; at: one of body, wheel"));
  CHECK(contains(refused(with("quantity: deflection", "quantity: travel")),
                 "unknown quantity 'travel'"));
  CHECK(contains(refused(with("0.2 mm", "-1 mm")), "noise is not above 0"));
  CHECK(contains(refused(with("30 Hz", "0 Hz")), "cut-off is not above 0 Hz"));
  CHECK(contains(refused(with("30 Hz", "30 ms")), "Hz"));
  CHECK(contains(refused(with("30 Hz", "{cutoff: 30 Hz, order: 2.5}")), "order is 2.5; 1 to 8"));
  CHECK(contains(refused(with("30 Hz", "{cutof: 30 Hz}")), "cutof"));
  CHECK(contains(refused(with("start: rest", "start: moving")), "rest or unknown"));
  CHECK(contains(refused(with("held_back: 0.3", "held_back: 1.3")), "0 to below 0.9"));
  CHECK(contains(refused(with("current: coil", "current: coil\nvoltage: 1")), "not by both"));
  CHECK(contains(refused(with("skip:", "skipp:")), "skipp"));
  CHECK(contains(refused(with("channel: level", "channel: road")), "both an input and a sensor"));
  CHECK(contains(refused(with("channel: level", "channel: body")), "is stated as two sensors"));
  CHECK(contains(refused(kCar + "parameters2: 1\n"), "parameters2"));

  // All but the damper must be linear.
  CHECK(contains(
      refused(with("  unsprung_mass: 40 kg\n", "  unsprung_mass: 40 kg\n  friction: 30 N\n")),
      "has stops or friction"));
}

TEST_CASE("a plant in words: known, unknown, ranges, places and levels") {
  const InPlantSetup setup = read_in_plant_setup(
      "quarter_car,sprung_mass=300..500 kg,unsprung_mass=40,spring_stiffness=20N/mm,"
      "tyre_stiffness=unknown,ground=road,acceleration=az@wheel,deflection=level,current=1.5A");
  REQUIRE(setup.unknown.size() == 2);
  CHECK(setup.unknown[0].lower == 300);
  CHECK(setup.unknown[0].upper == 500);
  CHECK(setup.sensors[0].channel == "az");
  CHECK(setup.sensors[0].place.coordinate == 1);
  CHECK(setup.drive_of(0).level == 1.5);
  CHECK(setup.drive_channels().empty());

  const auto wrong = [](const std::string& words) {
    return message_of([&] { read_in_plant_setup(words); });
  };
  CHECK(contains(wrong("oscillator,mass"), "'mass' has no '='"));
  CHECK(contains(wrong("oscillator,mas=1"), "unknown key 'mas'; did you mean 'mass'"));
  CHECK(contains(wrong("oscillator,force=u,displacement=x"), "says nothing of mass"));
  CHECK(contains(wrong("oscillator,mass=1,displacement=x"), "no input is stated"));
  CHECK(contains(wrong("oscillator,mass=1,skip=1,force=u,displacement=x,skip=2"),
                 "--in, skip: is stated twice"));
  CHECK(contains(wrong("oscillator,mass=1,force=u,displacement=x,mass=unknown"),
                 "--in, mass: is stated twice"));
  CHECK(read_in_plant_setup("oscillator,mass=1,force=u,displacement=x,displacement=y")
            .sensors.size() == 2);
  CHECK(contains(wrong("nowhere.yaml"), "there is no such file"));
}

TEST_CASE("a plant's recording counts what the plant says of its channels") {
  const TemporaryFolder folder;
  const InPlantSetup setup =
      read_in_plant_setup("oscillator,mass=1,stiffness=100,force=push,acceleration=a,current=coil");
  const auto read = [&](const std::string& head) {
    const PlantRecording recording = read_plant_recording(
        folder.write("ride.csv", head + "\n0,1,1,1\n0.1,2,2,1\n0.2,3,3,1\n"), setup.channels());
    require_units(setup, recording);
    return recording;
  };

  // The g of an accelerometer is that of gravity.
  CHECK_CLOSE(read("time [ms],push [N],a [g],coil").channel("a").samples[1], 2 * 9.80665, 1e-9, 0);
  CHECK_CLOSE(read("time,push,a [mg],coil").channel("a").samples[1], 2e-3 * 9.80665, 1e-9, 0);
  CHECK(read("time,push,a [mm/s^2],coil [mA]").channel("coil").samples[1] == 1e-3);

  const auto wrong = [&](const std::string& head) { return message_of([&] { read(head); }); };
  CHECK(contains(wrong("time,push,a [mm/s],coil"), "a: is in m/s (column a, mm/s), and the plant"));
  CHECK(contains(wrong("time,push [mm],a,coil"), "says that it is in N"));
  CHECK(contains(wrong("time,push,a,coil [V]"), "says that it is in A"));
}

TEST_CASE("a plant's recording: units in the names, one uniform time base, SI") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    return read_plant_recording(folder.write("ride.csv", text), {"level", "push"});
  };
  const PlantRecording recording =
      read("time [ms],level (mm),push,note\n0,1,5,a\n2,2,6,b\n4,4,7,c\n");
  CHECK(recording.sample_time == 0.002);
  CHECK(recording.samples == 3);
  CHECK_CLOSE(recording.channel("level").samples[2], 0.004, 1e-12, 0);
  CHECK(recording.channel("level").unit == "m");
  CHECK(contains(recording.channel("push").origin, "taken as SI"));
  CHECK(contains(message_of([&] { recording.channel("levle"); }), "did you mean 'level'"));

  const auto wrong = [&](const std::string& text) { return message_of([&] { read(text); }); };
  CHECK(contains(wrong("time,level\n0,1\n1,2\n2,4\n"), "has no column 'push'"));
  CHECK(contains(wrong("level,push\n0,1\n1,2\n2,4\n"), "has no column of time"));
  CHECK(contains(wrong("time,level [m],push,level [mm]\n0,1,1,1\n1,2,1,1\n2,4,1,1\n"),
                 "has two columns 'level' (it has 'time', 'level [m]', 'push', 'level [mm]')"));
  CHECK(contains(wrong("time [ms],level,push\n0,1,1\n2,2,2\n4,2,2\n9,4,3\n11,4,3\n"),
                 "ride.csv:5: its time stamps are not uniform: here they go on by 0.005 s, "
                 "elsewhere by 0.002 s; sample the plant at one rate, or resample the recording; "
                 "at a gap cut it into two files"));
  CHECK(contains(wrong("time [ms],level,push\n0,1,1\n2,,2\n4,2,2\n"),
                 "ride.csv:3: 'level' is '', not a number; write it as 12.5; a plant is run "
                 "through all samples, so fill a gap"));
  CHECK(contains(wrong("time,level,push\n0,1,1\n1,x,2\n2,4,3\n"), "'x', not a number"));
  CHECK(contains(wrong("t,level,push\n0,1,1\n2,2,2\n4,4,3\n"),
                 "time has no unit and steps of 2, which are no seconds of a plant; name the "
                 "column 't [ms]'"));
  CHECK(contains(wrong("t [s],level,push\n0,1,1\n2,2,2\n4,4,3\n"),
                 "time in s has steps of 2 s, which are no seconds of a plant; name the column "
                 "'t [ms]'"));
  CHECK(unread_drives({&recording, 1}).empty());
  const PlantRecording driven = read("time [ms],level,push,coil [V],F [N]\n0,1,5,1,1\n2,2,6,1,1\n");
  CHECK(
      contains(unread_drives({&driven, 1}),
               "coil [V]: not read, as the plant's file names no channel that drives the damper"));
  CHECK(without_units({&recording, 1}) ==
        "push: no unit in the columns' names, taken as SI; name them with it, as 'level [mm]' or "
        "'coil [A]'");
  CHECK(contains(wrong("time,level [smoot],push\n0,1,1\n1,1,2\n2,4,3\n"), "smoot"));
}
