#include "dashpot/record/channel_names.h"

#include "support.h"

using namespace dashpot;

TEST_CASE("columns are recognised by their names") {
  struct Known {
    const char *column, *row_unit, *channel, *unit;
  };
  const Known known[] = {
      {"t", "", "time", ""},
      {"t_s", "", "time", "s"},
      {"Time (ms)", "", "time", "ms"},
      {"x_mm", "", "displacement", "mm"},
      {"x [mm]", "", "displacement", "mm"},
      {"displacement(mm)", "", "displacement", "mm"},
      {"Desplazamiento_mm", "", "displacement", "mm"},
      {"Posi\xC3\xA7\xC3\xA3o [mm]", "", "displacement", "mm"},
      {"stroke", "mm", "displacement", "mm"},
      {"v_mm_s", "", "velocity", "mm/s"},
      {"Velocidad (m/s)", "", "velocity", "m/s"},
      {"Fuerza_N", "", "force", "N"},
      {"For\xE7"
       "a [kN]",
       "", "force", "kN"},
      {"F_N", "", "force", "N"},
      {"Force/kN", "", "force", "kN"},
      {"measured force", "N", "force", "N"},
      {"I [A]", "", "current", "A"},
      {"data.I_A", "", "current", "A"},
      {"run1.data.F_N", "", "force", "N"},
      {"data.x_mm", "", "displacement", "mm"},
      {"T_C", "", "temperature", "C"},
      {"T [s]", "", "time", "s"},
      {"current_A_nominal", "", "current", ""},
      {"V", "V", "voltage", "V"},
      {"V", "cm/s", "velocity", "cm/s"},
      {"A [g0]", "", "acceleration", "g0"},
      {"acc (g)", "", "acceleration", "g0"},
      {"acceleration", "g", "acceleration", "g0"},
      // As MATLAB, R and word processors write "Force (kN)", and as people do.
      {"Force_kN_", "", "force", "kN"},
      {"Velocity_mm_s_", "", "velocity", "mm/s"},
      {"force..kN.", "", "force", "kN"},
      {"Displacement mm.", "", "displacement", "mm"},
      {"Displacement\xC2\xA0[mm]", "", "displacement", "mm"},
      {"Force\xC2\xB9 [kN]", "", "force", "kN"},
      {"Force_kN_filt", "", "force", "kN"},
      {"kN force", "", "force", "kN"},
      {"Force|kN", "", "force", "kN"},
      {"mm cm displacement", "", "displacement", ""},
      {"load 10 kN cell", "", "force", ""},
      {"...", "", "", ""},
      {"10kN load", "", "force", ""},
      {"Force 2 kN", "", "force", "kN"},  // the second of several
      {"temperature 10 degC", "", "temperature", "degC"},
      // Quotients anywhere in a name, with exponents, points and words.
      {"velocity mm.s-1", "", "velocity", "mm.s-1"},
      {"vel_mm.s-1", "", "velocity", "mm.s-1"},
      {"v [mm s-1]", "", "velocity", "mm s-1"},
      {"velocity (mm per s)", "", "velocity", "mm per s"},
      {"velocity_mm_per_s", "", "velocity", "mm/s"},
      {"velocity mm/s filt", "", "velocity", "mm/s"},
      {"vel in mm/s, filtered", "", "velocity", "mm/s"},
      {"mm/s velocity", "", "velocity", "mm/s"},
      {"I [Amps]", "", "current", "Amps"},
      {"Current (milliamps)", "", "current", "milliamps"},
      {"Time (hh:mm:ss)", "", "time", ""},
      {"force.1", "", "force", ""},
      // Symbols of which more is said, where the unit fits.
      {"I meas [A]", "", "current", "A"},
      {"F_damper_filt [kN]", "", "force", "kN"},
      {"I_coil_A", "", "current", "A"},
      {"Acc [g]", "", "acceleration", "g0"},
  };
  for (const Known& k : known) {
    CAPTURE(std::string(k.column));
    const NamedChannel found = recognise_channel(k.column, k.row_unit);
    CHECK(found.channel == k.channel);
    CHECK(found.unit == k.unit);
    CHECK(found.problem.empty());
  }
}

TEST_CASE("what may mean two things, or is no measurement, is not used") {
  for (const char* column :
       {"A", "V", "T", "Y", "fs", "Sample Number", "target force", "displacement setpoint [mm]",
        "Weg Soll [mm]", "setpoint.I_A", "Peak force [N]", "x_F(2)", "force [mm]", "I meas",
        "I set [A]", "I_motor [A]", "F_d [N]", "I meas [V]", ""}) {
    CAPTURE(std::string(column));
    CHECK(recognise_channel(column, "").channel.empty());
  }
  for (const char* column :
       {"motor current [A]", "actuator_current_A", "load cell voltage (V)", "LVDT voltage (V)",
        "lateral force (N)", "gas force [kN]", "inertia force"}) {
    CAPTURE(std::string(column));
    CHECK(recognise_channel(column, "").channel.empty());
    CHECK(contains(recognise_channel(column, "").problem, "is not the damper's by its name"));
  }
  for (const char* column :
       {"coil current [A]", "valve current (mA)", "damper force (N)", "force load cell (N)"})
    CHECK(!recognise_channel(column, "").channel.empty());
  CHECK(recognise_channel("V", "").problem.find("velocity or voltage") != std::string::npos);
}

TEST_CASE("of two channels in a name the unit decides, and nothing without one") {
  const std::pair<const char*, const char*> known[] = {
      {"Extension force [N]", "force"},
      {"Current position [mm]", "displacement"},
      {"Load cell temperature, degC", "temperature"},
      {"Force sensor voltage [V]", "voltage"},
      {"velocidad desplazamiento [mm/s]", "velocity"},
      {"Position(Linear:Position) (mm)", "displacement"}};
  for (const auto& [column, channel] : known) {
    CAPTURE(std::string(column));
    CHECK(recognise_channel(column, "").channel == channel);
  }
  CHECK(recognise_channel("load displacement", "mm").channel == "displacement");
  for (const char* column : {"load displacement", "Current position", "Force sensor voltage"}) {
    CAPTURE(std::string(column));
    CHECK(recognise_channel(column, "").channel.empty());
    CHECK(contains(recognise_channel(column, "").problem, "' may be "));
  }
  CHECK(recognise_channel("Extension force [A]", "").problem ==
        "unit 'A' does not fit displacement");
}

TEST_CASE("two units for one channel") {
  CHECK(recognise_channel("x [mm]", "m").problem == "two units: 'mm' in its name and 'm' below it");
  CHECK(recognise_channel("x [mm]", "mm").problem.empty());
}

TEST_CASE("units that nobody knows are not taken as SI") {
  for (const char* column :
       {"Force_pounds", "Force in pounds", "Force KiloNewton", "velocity_mmps",
        "Displacement microns", "displacement [\"]", "displacement [0.1 mm]", "vel_mms-1"}) {
    CAPTURE(std::string(column));
    CHECK(recognise_channel(column, "").problem.starts_with("the unknown unit '"));
  }
}

TEST_CASE("factors in names, and ranges that may be units, are not taken as nothing") {
  for (const char* column : {"Force x1000 N", "Force N x10", "Force (x1000) N", "Force/1000 [N]",
                             "Force [N] x 1000", "Force \u00d7100 [N]", "Force_x0.1_N",
                             "Force [N] \u00b7 1000", "Weg in 1/10 mm", "Weg 1/100mm"}) {
    CAPTURE(std::string(column));
    CHECK(contains(recognise_channel(column, "").problem, "a factor '"));
  }
  CHECK(contains(recognise_channel("Force x1000", "N").problem, "a factor 'x1000'"));
  for (const char* column : {"Load cell 10 kN", "Displacement 50 mm", "Displacement 0.1 mm"}) {
    CAPTURE(std::string(column));
    CHECK(contains(recognise_channel(column, "").problem, "of the sensor or the unit"));
  }

  // Where both are the same, there is nothing to ask; nor of the first of several.
  CHECK(recognise_channel("Load cell 500 N", "").problem.empty());
  CHECK(recognise_channel("force x1 [N]", "").problem.empty());
}
