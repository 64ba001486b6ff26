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
      {"force.1", "", "force", ""},
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
  for (const char* column : {"A", "V", "T", "Y", "fs", "Sample Number", "target force",
                             "displacement setpoint [mm]", "x_F(2)", "force [mm]", ""}) {
    CAPTURE(std::string(column));
    CHECK(recognise_channel(column, "").channel.empty());
  }
  CHECK(recognise_channel("V", "").problem.find("velocity or voltage") != std::string::npos);
}

TEST_CASE("two units for one channel") {
  CHECK(recognise_channel("x [mm]", "m").problem == "two units: 'mm' in its name and 'm' below it");
  CHECK(recognise_channel("x [mm]", "mm").problem.empty());
}

TEST_CASE("units that nobody knows are not taken as SI") {
  for (const char* column : {"Force_pounds", "Force in pounds", "Force KiloNewton", "velocity_mmps",
                             "Displacement microns", "displacement [\"]"}) {
    CAPTURE(std::string(column));
    CHECK(recognise_channel(column, "").problem.starts_with("the unknown unit '"));
  }
}
