/* Steps an FMU through a run, on whatever system this is compiled for:
 *
 *   step_fmu LIBRARY VERSION TOKEN STEP INPUTS REFERENCE... < rows > outputs
 *
 * VERSION: of FMI, 2 or 3. REFERENCE: value references, of INPUTS inputs and one output. Each row
 * on stdin holds the inputs of an instant, STEP seconds after those before; each line on stdout the
 * output there, with all its digits. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#define load(path) ((void*)LoadLibraryA(path))
#define find(library, name) ((void*)GetProcAddress((HMODULE)(library), name))
#else
#include <dlfcn.h>
#define load(path) dlopen(path, RTLD_NOW | RTLD_LOCAL)
#define find(library, name) dlsym(library, name)
#endif

enum { kMostInputs = 64 };

typedef struct {
  void (*logger)(void*, const char*, int, const char*, const char*, ...);
  void* (*allocate)(size_t, size_t);
  void (*release)(void*);
  void (*finished)(void*, int);
  void* environment;
} Callbacks;

static void* library;

static void complain(void* environment, const char* name, int status, const char* category,
                     const char* message, ...) {
  (void)environment, (void)name, (void)status, (void)category;
  fprintf(stderr, "%s\n", message);
}

static void complain3(void* environment, int status, const char* category, const char* message) {
  complain(environment, "", status, category, message);
}

static void* function(const char* name) {
  void* found = find(library, name);
  if (!found) {
    fprintf(stderr, "step_fmu: the library has no %s\n", name);
    exit(1);
  }
  return found;
}

static void require(int status, const char* what) {
  if (status <= 1) return;
  fprintf(stderr, "step_fmu: %s gives status %d\n", what, status);
  exit(1);
}

/* Calls of one version as those of the other. */
typedef struct {
  int version;
  void* instance;
} Fmu;

static Fmu start(int version, const char* token) {
  static const Callbacks callbacks = {complain, calloc, free, NULL, NULL};
  Fmu fmu = {version, NULL};
  if (version == 2) {
    typedef void* (*Instantiate)(const char*, int, const char*, const char*, const Callbacks*, int,
                                 int);
    typedef int (*Setup)(void*, int, double, double, int, double);
    typedef int (*Enter)(void*);
    fmu.instance =
        ((Instantiate)function("fmi2Instantiate"))("step_fmu", 1, token, "", &callbacks, 0, 1);
    if (!fmu.instance) exit(1);
    require(((Setup)function("fmi2SetupExperiment"))(fmu.instance, 0, 0, 0, 0, 0), "setup");
    require(((Enter)function("fmi2EnterInitializationMode"))(fmu.instance), "initialization");
    return fmu;
  }
  typedef void* (*Instantiate)(const char*, const char*, const char*, _Bool, _Bool, _Bool, _Bool,
                               const unsigned*, size_t, void*,
                               void (*)(void*, int, const char*, const char*), void*);
  typedef int (*Enter)(void*, _Bool, double, double, _Bool, double);
  fmu.instance = ((Instantiate)function("fmi3InstantiateCoSimulation"))(
      "step_fmu", token, NULL, 0, 1, 0, 0, NULL, 0, NULL, complain3, NULL);
  if (!fmu.instance) exit(1);
  require(((Enter)function("fmi3EnterInitializationMode"))(fmu.instance, 0, 0, 0, 0, 0),
          "initialization");
  return fmu;
}

static void set(Fmu fmu, const unsigned* references, size_t count, const double* values) {
  typedef int (*Set2)(void*, const unsigned*, size_t, const double*);
  typedef int (*Set3)(void*, const unsigned*, size_t, const double*, size_t);
  require(fmu.version == 2
              ? ((Set2)function("fmi2SetReal"))(fmu.instance, references, count, values)
              : ((Set3)function("fmi3SetFloat64"))(fmu.instance, references, count, values, count),
          "an input");
}

static double get(Fmu fmu, unsigned reference) {
  typedef int (*Get2)(void*, const unsigned*, size_t, double*);
  typedef int (*Get3)(void*, const unsigned*, size_t, double*, size_t);
  double value = 0;
  require(fmu.version == 2
              ? ((Get2)function("fmi2GetReal"))(fmu.instance, &reference, 1, &value)
              : ((Get3)function("fmi3GetFloat64"))(fmu.instance, &reference, 1, &value, 1),
          "the output");
  return value;
}

static void initialised(Fmu fmu) {
  typedef int (*Exit)(void*);
  require(((Exit)function(fmu.version == 2 ? "fmi2ExitInitializationMode"
                                           : "fmi3ExitInitializationMode"))(fmu.instance),
          "the end of initialization");
}

static void step(Fmu fmu, double time, double size) {
  typedef int (*Step2)(void*, double, double, int);
  typedef int (*Step3)(void*, double, double, _Bool, _Bool*, _Bool*, _Bool*, double*);
  _Bool event = 0, terminate = 0, early = 0;
  double last = 0;
  require(fmu.version == 2 ? ((Step2)function("fmi2DoStep"))(fmu.instance, time, size, 1)
                           : ((Step3)function("fmi3DoStep"))(fmu.instance, time, size, 1, &event,
                                                             &terminate, &early, &last),
          "a step");
}

int main(int count, char** words) {
  if (count < 7) {
    fprintf(stderr, "step_fmu: LIBRARY VERSION TOKEN STEP INPUTS REFERENCE...\n");
    return 1;
  }
  const int inputs = atoi(words[5]);
  unsigned references[kMostInputs + 1];
  if (inputs < 0 || inputs > kMostInputs || count != 6 + inputs + 1) return 1;
  for (int k = 0; k <= inputs; ++k) references[k] = (unsigned)strtoul(words[6 + k], NULL, 10);

  library = load(words[1]);
  if (!library) {
    fprintf(stderr, "step_fmu: %s cannot be loaded\n", words[1]);
    return 1;
  }
  const double size = strtod(words[4], NULL);
  const Fmu fmu = start(atoi(words[2]), words[3]);

  /* As the reference run of the FMU was made: the inputs of an instant, then its output. */
  double values[kMostInputs];
  for (long n = 0;; ++n) {
    for (int k = 0; k < inputs; ++k)
      if (scanf("%lf", &values[k]) != 1) return k == 0 && n > 0 ? 0 : 1;
    if (n > 0) step(fmu, (double)(n - 1) * size, size);
    set(fmu, references, (size_t)inputs, values);
    if (n == 0) initialised(fmu);
    printf("%.17g\n", get(fmu, references[inputs]));
  }
}
