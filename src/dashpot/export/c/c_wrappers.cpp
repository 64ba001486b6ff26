#include "dashpot/export/c/c_wrappers.h"

#include <algorithm>

#include "dashpot/base/escape.h"
#include "dashpot/error.h"
#include "dashpot/export/c/c_source.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/c_subset/c_rewrite.h"

namespace dashpot {
namespace {

constexpr const char* kPackage = R"(within;
package @name@ "@title@"
  // @origin@

  class Damper "A damper at work, in the memory of its C code"
    extends ExternalObject;

    function constructor
      output Damper damper;
      external "C" damper = @name@_create() annotation(
        Include = "#include \"@name@_modelica.h\"", Library = "@name@");
    end constructor;

    function destructor
      input Damper damper;
      external "C" @name@_destroy(damper) annotation(
        Include = "#include \"@name@_modelica.h\"", Library = "@name@");
    end destructor;
  end Damper;

  impure function sample_force
    "Force one sample time after the last call; of the first call, at rest there"
    input Damper damper;
    input Real s(unit = "m") "Displacement, extension positive";
    input Real v(unit = "m/s") "Velocity, extension positive";
    input Real i(unit = "@unit@") "Command";
    output Real f(unit = "N") "Force, positive when it resists extension";
    external "C" f = @name@_sample(damper, s, v, i) annotation(
      Include = "#include \"@name@_modelica.h\"", Library = "@name@");
  end sample_force;

  block ForceBlock "From motion and command to force, held from sample to sample"
    constant Real sample_time(unit = "s") = @sample_time@ "Of the C code";
    Modelica.Blocks.Interfaces.RealInput s(unit = "m") "Displacement, extension positive";
    Modelica.Blocks.Interfaces.RealInput v(unit = "m/s") "Velocity, extension positive";
    Modelica.Blocks.Interfaces.RealInput i(unit = "@unit@") "Command";
    Modelica.Blocks.Interfaces.RealOutput f(unit = "N") "Force, positive when it resists extension";
  protected
    Damper damper = Damper();
    discrete Real held(unit = "N", start = 0, fixed = true);
  equation
    when sample(0, sample_time) then
      held = sample_force(damper, s, v, i);
    end when;
    f = held;
  end ForceBlock;

  model ForceElement "Between two flanges"
    extends Modelica.Mechanics.Translational.Interfaces.PartialCompliantWithRelativeStates;
    parameter Real s_rel0(unit = "m") = 0 "Distance of the flanges at displacement 0";
    Modelica.Blocks.Interfaces.RealInput i(unit = "@unit@") "Command";
  protected
    ForceBlock damper;
  equation
    damper.s = s_rel - s_rel0;
    damper.v = v_rel;
    damper.i = i;
    f = damper.f;
  end ForceElement;

  annotation(
    version = "1",
    uses(Modelica(version = "4.0.0")),
    Documentation(info = "<html>
<p>@title@. Inputs: displacement s in m and velocity v in m/s, extension positive; command i in
@unit@. Output: force f in N, positive when it resists extension. Known for
s = @x_min@ ... @x_max@ m, v = @v_min@ ... @v_max@ m/s, i = @i_min@ ... @i_max@ @unit@;
beyond, the model extrapolates.</p>
<p>The force comes from C code, every @sample_time@ s. Before the first use, in the package's
folder:</p>
<pre>mkdir -p Resources/Library/linux64
cc -std=c99 -O2 -fPIC -c Resources/Include/@name@.c -o @name@.o
ar rcs Resources/Library/linux64/lib@name@.a @name@.o</pre>
<p>Made by Dashpot @version@: <code>@command@</code></p>
</html>"));
end @name@;
)";

/// What no package can be called: the keywords of Modelica 3.5 (2.3.3), its predefined types, and
/// the library that the package uses.
constexpr std::string_view kTakenInModelica[] = {
    "algorithm",   "and",          "annotation", "block",       "break",
    "class",       "connect",      "connector",  "constant",    "constrainedby",
    "der",         "discrete",     "each",       "else",        "elseif",
    "elsewhen",    "encapsulated", "end",        "enumeration", "equation",
    "expandable",  "extends",      "external",   "false",       "final",
    "flow",        "for",          "function",   "if",          "import",
    "impure",      "in",           "initial",    "inner",       "input",
    "loop",        "model",        "not",        "operator",    "or",
    "outer",       "output",       "package",    "parameter",   "partial",
    "protected",   "public",       "pure",       "record",      "redeclare",
    "replaceable", "return",       "stream",     "then",        "true",
    "type",        "when",         "while",      "within",      "Boolean",
    "Integer",     "Modelica",     "Real",       "String",      "StateSelect",
    "time"};

void require_free_in_modelica(const std::string& name) {
  if (std::ranges::find(kTakenInModelica, name) != std::end(kTakenInModelica))
    throw Error("name", "'" + name + "' has a meaning of its own in Modelica: no package has it",
                "as " + name + "_damper");
}

std::vector<std::pair<std::string, ModelicaText>> package_facts(const ExportedModel& model,
                                                                const ExportOptions& options,
                                                                const CSource& source) {
  std::vector<std::pair<std::string, ModelicaText>> facts{
      {"name", ModelicaText::own(source.prefix)},
      {"title", modelica_markup(title_of(model.model))},
      {"unit", ModelicaText::own(unit_of(model.drive_unit))},
      {"origin", modelica_comment(model.origin)},
      {"command", modelica_markup(options.command)}};
  for (const auto& [name, number] : common_facts(model, options, source))
    facts.emplace_back(name, ModelicaText::own(number.text()));
  return facts;
}

std::vector<ExportedFile> with_wrapper(const ExportedModel& model, const ExportOptions& options,
                                       const std::string& text, const std::string& ending) {
  const CSource source = c_source(model, options);
  std::string wrapper = with_prefix(c_text(text), source.prefix);
  const std::string sources = source.prefix + "_model.c", header = "\"damper.h\"";
  for (std::size_t at = 0; (at = wrapper.find(sources, at)) != std::string::npos;)
    wrapper.replace(at, sources.size(), source.prefix + ".c");
  if (const std::size_t at = wrapper.find(header); at != std::string::npos)
    wrapper.replace(at, header.size(), '"' + source.prefix + ".h\"");
  return {{source.prefix + ".h", source.header},
          {source.prefix + ".c", source.source},
          {source.prefix + ending, wrapper}};
}

}  // namespace

std::vector<ExportedFile> write_mex(const ExportedModel& model, const ExportOptions& options) {
  return with_wrapper(model, options, "mex.c", "_mex.c");
}

std::vector<ExportedFile> write_sfunction(const ExportedModel& model,
                                          const ExportOptions& options) {
  return with_wrapper(model, options, "sfunction.c", "_sfun.c");
}

std::vector<ExportedFile> write_modelica(const ExportedModel& model, const ExportOptions& options) {
  const CSource source = c_source(model, options);
  require_free_in_modelica(source.prefix);
  std::vector<ExportedFile> files = with_wrapper(model, options, "modelica.h", "_modelica.h");
  for (ExportedFile& file : files) file.name = source.prefix + "/Resources/Include/" + file.name;
  files.push_back(
      {source.prefix + "/package.mo", filled(kPackage, package_facts(model, options, source))});
  return files;
}

}  // namespace dashpot
