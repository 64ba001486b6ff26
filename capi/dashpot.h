#ifndef DASHPOT_H
#define DASHPOT_H

// Dashpot for other languages: C99, and the only boundary that Python and other programs see.
//
// Units are SI: m, m/s, A (V where a model is driven in V), N, s. Extension is positive; a force is
// positive when it resists extension. Text is UTF-8; options and reports are JSON.
//
// Every function but the few that return a plain value returns a status, and leaves a message for
// people in dashpot_last_error() unless it is DASHPOT_OK. Null pointers, wrong sizes, numbers that
// are not finite and unknown names give DASHPOT_BAD_INPUT. What a function makes is written through
// its last pointers, null when it failed, and belongs to the caller, who gives it back to the _free
// function of its kind; that sets the caller's pointer to null, so giving back twice does nothing.
//
// Models and rankings never change: any number of threads may use one. Recordings may be used so
// once the last one is added. A state array belongs to one thread at a time.

#include <stddef.h>

#if defined(__GNUC__)
#define DASHPOT_API __attribute__((visibility("default")))
#else
#define DASHPOT_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum dashpot_status {
  DASHPOT_OK = 0,
  DASHPOT_BAD_INPUT = 1,   ///< an argument, a file or the recordings cannot be used
  DASHPOT_NOT_USABLE = 2,  ///< it ran, but a model diverged or a fit failed
  DASHPOT_CANCELLED = 3,   ///< the monitor asked to stop
  DASHPOT_FAILED = 4       ///< no memory, or a fault of Dashpot
} dashpot_status;

/// "0.1.0"; never to be freed.
DASHPOT_API const char* dashpot_version(void);
/// The reason why the last failing call of this thread failed: "where: what; what would
/// be right". Empty before; valid until the thread's next failing call; never null.
DASHPOT_API const char* dashpot_last_error(void);
/// Frees a text that a function wrote through a char**, and sets the pointer to null.
DASHPOT_API void dashpot_text_free(char** text);

// ---- Arrays -----------------------------------------------------------------

/// Samples where they lie in the caller's memory: sample k is data[k * stride]. Stride 1: one
/// behind the other. Stride 0: one value that holds for every sample. Null data: there is none.
typedef struct dashpot_column {
  const double* data;
  ptrdiff_t stride;
} dashpot_column;

/// The inputs of a damper at one instant.
typedef struct dashpot_input {
  double displacement;  ///< m, extension positive
  double velocity;      ///< m/s, extension positive
  double current;       ///< A commanded to the coil; V where the model's drive unit is "V"
} dashpot_input;

/// The inputs of a damper over time.
typedef struct dashpot_motion {
  size_t samples;
  double sample_time;           ///< s between samples; asked only where there is no column of time
  dashpot_column time;          ///< s, increasing
  dashpot_column displacement;  ///< m; may be absent where the model does not need it
  dashpot_column velocity;      ///< m/s
  dashpot_column current;       ///< A or V
} dashpot_motion;

// ---- Models -----------------------------------------------------------------

typedef struct dashpot_model dashpot_model;

typedef struct dashpot_model_info {
  const char* name;        ///< "tanh_kwok"; as the other texts: valid as long as the model
  const char* kind;        ///< "law", "network", "narx" ...
  const char* title;       ///< for people
  const char* drive_unit;  ///< "A", "V", or "" at one constant, unknown drive
  size_t state_size;       ///< numbers in a state array; may be 0
  size_t parameter_count;
  int needs_displacement;
  double sample_time;  ///< s, of the data that it was fitted on; 0: mixed or unknown
  /// The range of those data: outside, the model extrapolates. All 0: unknown.
  double displacement_min, displacement_max;  ///< m
  double velocity_min, velocity_max;          ///< m/s
  double current_min, current_max;            ///< A or V
  double interval_level;  ///< share of left-out samples that its band claims to hold, 0.9; 0: it
                          ///< has no band
} dashpot_model_info;

/// A model file as `dashpot identify` or dashpot_model_save wrote it.
DASHPOT_API dashpot_status dashpot_model_load(const char* path, dashpot_model** model);
/// The text of such a file.
DASHPOT_API dashpot_status dashpot_model_parse(const char* text, dashpot_model** model);
/// A set of parameters from the literature, by the name that `dashpot models` knows it by:
/// "spencer1997".
DASHPOT_API dashpot_status dashpot_model_published(const char* name, dashpot_model** model);
DASHPOT_API dashpot_status dashpot_model_save(const dashpot_model* model, const char* path);
DASHPOT_API dashpot_status dashpot_model_text(const dashpot_model* model, char** text);
/// The numbers of a law as JSON: {"parameters": [{"name", "unit", "meaning", "value", "low",
/// "high"}], "covariance": [[...]]}, in SI; the 95 % intervals and the covariance matrix are null
/// where the file does not have them of a fit. No parameters where the model is no law.
DASHPOT_API dashpot_status dashpot_model_parameters(const dashpot_model* model, char** text);
DASHPOT_API dashpot_status dashpot_model_get_info(const dashpot_model* model,
                                                  dashpot_model_info* info);
DASHPOT_API void dashpot_model_free(dashpot_model** model);

// Stepping. A state array has info.state_size numbers, given as `state_size` for safety; null where
// that is 0. Allocates nothing.

/// The state after a long rest at the input's displacement and current.
DASHPOT_API dashpot_status dashpot_rest(const dashpot_model* model, const dashpot_input* input,
                                        double* state, size_t state_size);
/// Brings the state from the instant of `from` to that of `to`, `dt` > 0 s later; inputs are linear
/// between. Any step will do: a model with a sample time of its own keeps its grid inside.
DASHPOT_API dashpot_status dashpot_advance(const dashpot_model* model, const dashpot_input* from,
                                           const dashpot_input* to, double dt, double* state,
                                           size_t state_size);
/// N at this instant. DASHPOT_NOT_USABLE where it is not finite or the model has diverged.
DASHPOT_API dashpot_status dashpot_force(const dashpot_model* model, const dashpot_input* input,
                                         const double* state, size_t state_size, double* force);

/// The caller's arrays that dashpot_run fills; they must not overlap the motion's columns.
typedef struct dashpot_response {
  double* force;       ///< N, one per sample
  double* half_width;  ///< N: force +- half_width is the model's band; null: not wanted
  double* state;  ///< at the first sample before, at the last one after; null: from rest, not kept
  size_t state_size;
} dashpot_response;

/// The force over a whole motion in free run. To go on with another motion in the same state, have
/// it start with the last sample of this one. DASHPOT_NOT_USABLE where the model diverges: force
/// from there on is NaN.
DASHPOT_API dashpot_status dashpot_run(const dashpot_model* model, const dashpot_motion* motion,
                                       const dashpot_response* response);

// ---- Recordings -------------------------------------------------------------

typedef struct dashpot_recordings dashpot_recordings;

/// Files, folders or a dataset file, as `dashpot inspect` reads them. Options (null: none):
/// {"dataset": "FILE", "recognise": true, "velocity_cutoff": Hz}.
DASHPOT_API dashpot_status dashpot_recordings_load(const char* const* paths, size_t count,
                                                   const char* options,
                                                   dashpot_recordings** recordings);

/// A column with its name, which states channel and unit as a CSV file's header does: "velocity"
/// (SI), "x [mm]", "F_N".
typedef struct dashpot_named_column {
  const char* name;
  dashpot_column column;
} dashpot_named_column;

/// One recording in the caller's arrays. It needs force, velocity or displacement (velocity is then
/// derived as for files) and current or voltage.
typedef struct dashpot_table {
  const char* name;  ///< of the recording, for reports; null: numbered
  size_t samples;
  double sample_time;  ///< s; asked only where no column is time
  const dashpot_named_column* columns;
  size_t column_count;
  const char* conditions;  ///< JSON, SI: {"gap": 0.001}; null: none
} dashpot_table;

/// Recordings that dashpot_recordings_add fills.
DASHPOT_API dashpot_status dashpot_recordings_new(dashpot_recordings** recordings);
/// Copies the samples. The force's sign is taken as it is, resisting extension positive. A gap in
/// time of more than 5 median steps ends one recording and begins the next, NAME, stretch 1, 2 ...
/// On failure nothing is added.
DASHPOT_API dashpot_status dashpot_recordings_add(dashpot_recordings* recordings,
                                                  const dashpot_table* table);
DASHPOT_API size_t dashpot_recordings_count(const dashpot_recordings* recordings);
/// A text for people that says how every column was understood.
DASHPOT_API dashpot_status dashpot_recordings_describe(const dashpot_recordings* recordings,
                                                       char** text);
/// The files of a folder that are recordings by their format and could not be used, as a JSON array
/// of {"file", "why"}: results are those of the others.
DASHPOT_API dashpot_status dashpot_recordings_unread(const dashpot_recordings* recordings,
                                                     char** json);
/// What speaks against recordings, which are used nevertheless, as a JSON array of {"record",
/// "why"}: a unit that no damper has, a force that stands still or has lost its sign ...
DASHPOT_API dashpot_status dashpot_recordings_suspects(const dashpot_recordings* recordings,
                                                       char** json);

typedef struct dashpot_record_info {
  const char* name;  ///< as `condition`: valid until the recordings change or are freed
  const char* condition;
  const double*
      time;  ///< s, `samples` numbers; as channels' data valid until the recordings are freed
  size_t samples;
  size_t channel_count;
  double sample_time;  ///< s; 0: not uniform
} dashpot_record_info;

typedef struct dashpot_channel {
  const char* name;    ///< "velocity"; as the unit valid until the recordings change or are freed
  const char* unit;    ///< SI
  const double* data;  ///< `samples` numbers
} dashpot_channel;

DASHPOT_API dashpot_status dashpot_recordings_get_info(const dashpot_recordings* recordings,
                                                       size_t record, dashpot_record_info* info);
DASHPOT_API dashpot_status dashpot_recordings_channel(const dashpot_recordings* recordings,
                                                      size_t record, size_t channel,
                                                      dashpot_channel* view);
DASHPOT_API void dashpot_recordings_free(dashpot_recordings** recordings);

/// The meaning of a column by its name: `channel` becomes "velocity", "time" ... or "" when the
/// name is not known; SI = factor * value + shift.
typedef struct dashpot_column_meaning {
  char channel[32];
  double factor, shift;
} dashpot_column_meaning;
DASHPOT_API dashpot_status dashpot_understand_column(const char* name,
                                                     dashpot_column_meaning* meaning);

// ---- Identification ---------------------------------------------------------

/// The caller's side of long work. Both functions are called, some twenty times a second, on the
/// thread that called Dashpot; either may be null. They must return normally.
typedef struct dashpot_monitor {
  int (*is_cancelled)(void* context);  ///< not 0: stop soon, with DASHPOT_CANCELLED
  void (*on_progress)(const char* stage, double fraction, void* context);  ///< fraction: 0 ... 1
  void* context;
} dashpot_monitor;

/// One model on all recordings in free run, without judging it. Options in the words of `dashpot
/// identify`:
/// {"models": ["bingham"], "force_offset": "record", "form": ["alpha=exponential"], "fix": [...],
/// "free":
/// [...], "bounds": [...], "prior": [...], "allow_active": false, "asymmetric": false, "network":
/// [...], "from": ["MODEL FILE"], "starts": 4, "search": 0, "seed": 1, "threads": 0, "command":
/// "TEXT that the model file keeps"}; "models" has one here, the others may be absent. The report
/// (null: not wanted) has status, parameters with 95 % intervals, offsets and warnings.
DASHPOT_API dashpot_status dashpot_fit(const dashpot_recordings* recordings, const char* options,
                                       const dashpot_monitor* monitor, dashpot_model** model,
                                       char** report);

typedef struct dashpot_ranking dashpot_ranking;

/// Identifies as `dashpot identify` does: fits every model, judges each on recordings that it has
/// not seen, ranks them. Options as for dashpot_fit, and "leave_out": "condition", "current=0.5",
/// "blocks=5", "fraction=0.3" ...; "models" may hold the groups "usual" (when absent), "all" and
/// "family"; "budget": minutes on two cores, by estimated cost, that the models of "usual" (when
/// absent: 2) and "all" (when absent: no limit) may take, 0: no limit; "keep_inertia": true leaves
/// the force as recorded where errors left out show an inertia between load cell and damper. The
/// report says what was not tried.
DASHPOT_API dashpot_status dashpot_identify(const dashpot_recordings* recordings,
                                            const char* options, const dashpot_monitor* monitor,
                                            dashpot_ranking** ranking);
DASHPOT_API size_t dashpot_ranking_count(const dashpot_ranking* ranking);
/// The model at a place, 0 being the best, fitted on all training recordings.
DASHPOT_API dashpot_status dashpot_ranking_model(const dashpot_ranking* ranking, size_t place,
                                                 dashpot_model** model);
/// Its report as "json", "html", "markdown", "csv" or "text" (a table for a terminal).
DASHPOT_API dashpot_status dashpot_ranking_report(const dashpot_ranking* ranking,
                                                  const char* format, char** text);
DASHPOT_API void dashpot_ranking_free(dashpot_ranking** ranking);

/// A model on recordings in free run, without fitting: what `dashpot evaluate --json` prints.
/// Options (null: none): {"force_offset": "record", "threads": 0, "keep_inertia": false}; the last
/// leaves the force as it was recorded where the model was fitted to forces that were freed of the
/// inertia between load cell and damper.
DASHPOT_API dashpot_status dashpot_evaluate(const dashpot_model* model,
                                            const dashpot_recordings* recordings,
                                            const char* options, char** report);

/// The same runs, sample by sample: a recording each with motion, drive and the forces "measured",
/// "modelled" and "residual", the record's force zero included. Options as for dashpot_evaluate.
DASHPOT_API dashpot_status dashpot_traces(const dashpot_model* model,
                                          const dashpot_recordings* recordings, const char* options,
                                          dashpot_recordings** made);

// ---- Without a fit ----------------------------------------------------------

/// What recordings say by themselves: `dashpot characterise`. Options (null: none): {"speeds":
/// [m/s,
/// ...], "format": "json", "html", "markdown", "text" or "csv" (every cycle), "command": "TEXT that
/// the page keeps"}.
DASHPOT_API dashpot_status dashpot_characterise(const dashpot_recordings* recordings,
                                                const char* options, char** text);

/// A model or recordings, the other one null.
typedef struct dashpot_thing {
  const char* name;  ///< for people
  const dashpot_model* model;
  const dashpot_recordings* recordings;
} dashpot_thing;

/// The first of two or more things beside each of the others: `dashpot compare`. Options as for
/// dashpot_characterise, without "csv".
DASHPOT_API dashpot_status dashpot_compare(const dashpot_thing* things, size_t count,
                                           const char* options, char** text);

// ---- Export -----------------------------------------------------------------

/// Writes a model as files for other programs, as `dashpot export` does: {"to": ["c", "fmu3"],
/// "folder": "dashpot-export", "name": "front_damper", "precision": "double", "sample_time": s,
/// "compiler": "cc", "sources_only": false, "command": "TEXT that the files keep"}; all but "to"
/// may be absent. The report (null: not wanted) is {"files": ["dashpot-export/front_damper.c",
/// ...]}. Nothing is written where a model cannot become one of these.
DASHPOT_API dashpot_status dashpot_export(const dashpot_model* model, const char* options,
                                          char** report);

// ---- Vehicles ---------------------------------------------------------------

/// A vehicle or building from rest, in the words of `dashpot simulate`, with SI units: {"plant":
/// "savaresi_spelta", "set": ["sprung_mass=350kg"], "dampers": ["model.json"], "controller":
/// "mix1,crossover=1.9Hz", "inverse": "numeric", "current": 0, "current_max": 0, "lag_rate": -1,
/// "sample_time": 0.001, "in_car": false, "delay": 0, "road": "iso8608,class=C", "duration": 20,
/// "output_step": 0.001, "seed": 1}; all may be absent. `trace`: recordings that hold one, with a
/// channel for everything that moved. The report (null: not wanted) has the road, the measures of
/// `dashpot simulate` (where output_step is absent), notes, warnings and where it diverged;
/// DASHPOT_NOT_USABLE then, with the trace up to there.
DASHPOT_API dashpot_status dashpot_simulate(const char* options, const dashpot_monitor* monitor,
                                            dashpot_recordings** trace, char** report);

// ---- Dampers inside a plant -------------------------------------------------

/// What sensors recorded of a plant: channels of any name, of which the plant says which is which.
typedef struct dashpot_rides dashpot_rides;

DASHPOT_API dashpot_status dashpot_rides_new(dashpot_rides** rides);
/// One table per file, of any format that recordings come in; a folder stands for those in it.
DASHPOT_API dashpot_status dashpot_rides_load(dashpot_rides* rides, const char* path);
/// Copies the samples. Names hold their units: "az_body [m/s^2]"; without one: SI. Time is in
/// `sample_time` or in a column "time". `conditions` must be null. On failure nothing is added.
DASHPOT_API dashpot_status dashpot_rides_add(dashpot_rides* rides, const dashpot_table* table);
DASHPOT_API size_t dashpot_rides_count(const dashpot_rides* rides);
DASHPOT_API void dashpot_rides_free(dashpot_rides** rides);

/// The damper as the unknown part of a plant: `dashpot identify --in`. `plant`: a file, words, or
/// the text of such a file (docs/in-plant.md). Options in the words of the command: {"models":
/// ["tanh_kwok"], "form": [...], "fix": [...], "free": [...], "bounds": [...], "starts": 12,
/// "seed": 1, "threads": 0, "grade": "car", "profile": ["sprung_mass"], "command": "TEXT that the
/// model file keeps"}; "models" has one name here, the others may be absent. The report (null: not
/// wanted) is that of the command, and "found": the plant as it was found, which dashpot_observe
/// takes. DASHPOT_NOT_USABLE where the plant diverges wherever the fit begins; the report says how.
DASHPOT_API dashpot_status dashpot_identify_in_plant(const dashpot_rides* rides, const char* plant,
                                                     const char* options,
                                                     const dashpot_monitor* monitor,
                                                     dashpot_model** model, char** report);
/// The same where dampers need not be alike (dashpot_identify_in_plant takes them for such): each
/// kind that the plant states or the sensors tell apart has a model of its own. `models`: `room`
/// places, as many as the plant has dampers; the first `count` of them are set, in the order in
/// which "found" of the report has the kinds under "damper_kinds", each with its struts; without
/// that there is one.
DASHPOT_API dashpot_status dashpot_identify_dampers_in_plant(const dashpot_rides* rides,
                                                             const char* plant, const char* options,
                                                             const dashpot_monitor* monitor,
                                                             dashpot_model** models, size_t room,
                                                             size_t* count, char** report);

/// What no sensor showed of a plant whose damper is known: `dashpot observe`. Options (null: none):
/// {"causal": false, "force_error": [[N, s], ...], "velocity_shift": [m/s, s], "level": 0.9,
/// "steps": 0, "threads": 0}; an error of the force that stays: [N].
/// `estimates`: a recording for each ride, with damper_force, the plant's motion and the road, and
/// of each half the width of its band as "NAME_half_band". In a plant with several dampers this one
/// stands in each strut, and the forces are "front_damper_force" and so on. A sensor whose noise
/// the plant does not state has that which the identification of plant or model found; the report
/// (null: not wanted) says so ("sensor_noise_from"), and has the uncertainties, how the sensors
/// fitted them, and warnings.
DASHPOT_API dashpot_status dashpot_observe(const dashpot_model* model, const dashpot_rides* rides,
                                           const char* plant, const char* options,
                                           const dashpot_monitor* monitor,
                                           dashpot_recordings** estimates, char** report);

/// The damper in one strut of a plant, as "front", or those of one kind; `strut` null: in every
/// strut, where it is the only one.
typedef struct {
  const char* strut;
  const dashpot_model* model;
} dashpot_placed_model;

/// A plant and its dampers in free run, on recordings that no fit has seen: `dashpot evaluate
/// --in`. Options (null: none): {"steps": 0, "threads": 0}, steps of the integrator per sample.
/// `runs` (null: not wanted): a recording for each ride, with every sensor as measured and as
/// "NAME_modelled", and each damper's force, deflection and velocity. The report has the rms error
/// of every sensor.
DASHPOT_API dashpot_status dashpot_evaluate_in_plant(const dashpot_placed_model* dampers,
                                                     size_t count, const dashpot_rides* rides,
                                                     const char* plant, const char* options,
                                                     const dashpot_monitor* monitor,
                                                     dashpot_recordings** runs, char** report);

/// dashpot_observe() where dampers are not alike: one in each strut, in any order.
DASHPOT_API dashpot_status dashpot_observe_dampers(const dashpot_placed_model* dampers,
                                                   size_t count, const dashpot_rides* rides,
                                                   const char* plant, const char* options,
                                                   const dashpot_monitor* monitor,
                                                   dashpot_recordings** estimates, char** report);

/// A damper that works in a plant, followed from day to day: `dashpot watch`. In a plant with
/// several this one stands in each strut, each is followed ("front_force"), and the rate of false
/// alarms is that of all their charts together. One ride per day, in their order. Options (null:
/// none): {"tracked": ["force"], "level": "CHANNEL", "known":
/// ["CHANNEL"], "reference": 20, "false_alarms": 0.001, "threads": 0, "state": ...}. The report is
/// that of the command, and "state": given to the next call, its days stand before the new ones and
/// are not looked at again. "warnings" are sentences: names that tell another order of the days
/// than they are given in, dampers that the sensors hardly tell apart; those that they cannot tell
/// apart are DASHPOT_BAD_INPUT.
DASHPOT_API dashpot_status dashpot_watch(const dashpot_model* model, const dashpot_rides* rides,
                                         const char* plant, const char* options,
                                         const dashpot_monitor* monitor, char** report);

/// dashpot_watch() where dampers are not alike: one in each strut, in any order.
DASHPOT_API dashpot_status dashpot_watch_dampers(const dashpot_placed_model* dampers, size_t count,
                                                 const dashpot_rides* rides, const char* plant,
                                                 const char* options,
                                                 const dashpot_monitor* monitor, char** report);

#ifdef __cplusplus
}
#endif

#endif
