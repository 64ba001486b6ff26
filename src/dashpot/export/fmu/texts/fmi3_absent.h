/* The functions of FMI 3.0 that have nothing to do here. */
#ifndef FMI3_ABSENT_H
#define FMI3_ABSENT_H
#include "fmi3_types.h"

/* A function that this FMU does not have: an error once the caller has an instance. */
static fmi3Status unsupported(fmi3Instance i, const char* function) {
  return fmu_may(i, function, FMU_ANY) ? (fmi3Status)fmu_fail(i, function, "is not supported")
                                       : fmi3Error;
}

/* Every variable is a Float64: asking for none of another type is fine. */
static fmi3Status no_variables(fmi3Instance i, const char* function, size_t count) {
  if (!fmu_may(i, function, FMU_ANY)) {
    return fmi3Error;
  }
  return (count == 0) ? fmi3OK
                      : (fmi3Status)fmu_fail(i, function, "there are no variables of this type");
}

#define FMI3_NO_VARIABLES(type)                                                                   \
  FMI3_API fmi3Status fmi3Get##type(                                                              \
      fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences, \
      fmi3##type values[], size_t nValues) {                                                      \
    (void)valueReferences;                                                                        \
    (void)values;                                                                                 \
    (void)nValues;                                                                                \
    return no_variables(instance, "fmi3Get" #type, nValueReferences);                             \
  }                                                                                               \
  FMI3_API fmi3Status fmi3Set##type(                                                              \
      fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences, \
      const fmi3##type values[], size_t nValues) {                                                \
    (void)valueReferences;                                                                        \
    (void)values;                                                                                 \
    (void)nValues;                                                                                \
    return no_variables(instance, "fmi3Set" #type, nValueReferences);                             \
  }
FMI3_NO_VARIABLES(Float32)
FMI3_NO_VARIABLES(Int8)
FMI3_NO_VARIABLES(UInt8)
FMI3_NO_VARIABLES(Int16)
FMI3_NO_VARIABLES(UInt16)
FMI3_NO_VARIABLES(Int32)
FMI3_NO_VARIABLES(UInt32)
FMI3_NO_VARIABLES(Int64)
FMI3_NO_VARIABLES(UInt64)
FMI3_NO_VARIABLES(Boolean)
FMI3_NO_VARIABLES(String)

FMI3_API fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, size_t valueSizes[], fmi3Binary values[],
                                  size_t nValues) {
  (void)valueReferences;
  (void)valueSizes;
  (void)values;
  (void)nValues;
  return no_variables(instance, "fmi3GetBinary", nValueReferences);
}

FMI3_API fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, const size_t valueSizes[],
                                  const fmi3Binary values[], size_t nValues) {
  (void)valueReferences;
  (void)valueSizes;
  (void)values;
  (void)nValues;
  return no_variables(instance, "fmi3SetBinary", nValueReferences);
}

FMI3_API fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                 size_t nValueReferences, fmi3Clock values[]) {
  (void)valueReferences;
  (void)values;
  return no_variables(instance, "fmi3GetClock", nValueReferences);
}

FMI3_API fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                 size_t nValueReferences, const fmi3Clock values[]) {
  (void)valueReferences;
  (void)values;
  return no_variables(instance, "fmi3SetClock", nValueReferences);
}

FMI3_API fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance,
                                                        fmi3ValueReference valueReference,
                                                        size_t* nDependencies) {
  (void)valueReference;
  (void)nDependencies;
  return unsupported(instance, "fmi3GetNumberOfVariableDependencies");
}

FMI3_API fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                                size_t elementIndicesOfDependent[],
                                                fmi3ValueReference independents[],
                                                size_t elementIndicesOfIndependents[],
                                                fmi3DependencyKind dependencyKinds[],
                                                size_t nDependencies) {
  (void)dependent;
  (void)elementIndicesOfDependent;
  (void)independents;
  (void)elementIndicesOfIndependents;
  (void)dependencyKinds;
  (void)nDependencies;
  return unsupported(instance, "fmi3GetVariableDependencies");
}

FMI3_API fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance,
                                             const fmi3ValueReference unknowns[], size_t nUnknowns,
                                             const fmi3ValueReference knowns[], size_t nKnowns,
                                             const fmi3Float64 seed[], size_t nSeed,
                                             fmi3Float64 sensitivity[], size_t nSensitivity) {
  (void)unknowns;
  (void)nUnknowns;
  (void)knowns;
  (void)nKnowns;
  (void)seed;
  (void)nSeed;
  (void)sensitivity;
  (void)nSensitivity;
  return unsupported(instance, "fmi3GetAdjointDerivative");
}

FMI3_API fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
  return unsupported(instance, "fmi3EnterConfigurationMode");
}

FMI3_API fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
  return unsupported(instance, "fmi3ExitConfigurationMode");
}

FMI3_API fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance,
                                           const fmi3ValueReference valueReferences[],
                                           size_t nValueReferences, fmi3Float64 intervals[],
                                           fmi3IntervalQualifier qualifiers[]) {
  (void)valueReferences;
  (void)intervals;
  (void)qualifiers;
  return no_variables(instance, "fmi3GetIntervalDecimal", nValueReferences);
}

FMI3_API fmi3Status fmi3GetIntervalFraction(fmi3Instance instance,
                                            const fmi3ValueReference valueReferences[],
                                            size_t nValueReferences, fmi3UInt64 counters[],
                                            fmi3UInt64 resolutions[],
                                            fmi3IntervalQualifier qualifiers[]) {
  (void)valueReferences;
  (void)counters;
  (void)resolutions;
  (void)qualifiers;
  return no_variables(instance, "fmi3GetIntervalFraction", nValueReferences);
}

FMI3_API fmi3Status fmi3GetShiftDecimal(fmi3Instance instance,
                                        const fmi3ValueReference valueReferences[],
                                        size_t nValueReferences, fmi3Float64 shifts[]) {
  (void)valueReferences;
  (void)shifts;
  return no_variables(instance, "fmi3GetShiftDecimal", nValueReferences);
}

FMI3_API fmi3Status fmi3GetShiftFraction(fmi3Instance instance,
                                         const fmi3ValueReference valueReferences[],
                                         size_t nValueReferences, fmi3UInt64 counters[],
                                         fmi3UInt64 resolutions[]) {
  (void)valueReferences;
  (void)counters;
  (void)resolutions;
  return no_variables(instance, "fmi3GetShiftFraction", nValueReferences);
}

FMI3_API fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance,
                                           const fmi3ValueReference valueReferences[],
                                           size_t nValueReferences, const fmi3Float64 intervals[]) {
  (void)valueReferences;
  (void)intervals;
  return no_variables(instance, "fmi3SetIntervalDecimal", nValueReferences);
}

FMI3_API fmi3Status fmi3SetIntervalFraction(fmi3Instance instance,
                                            const fmi3ValueReference valueReferences[],
                                            size_t nValueReferences, const fmi3UInt64 counters[],
                                            const fmi3UInt64 resolutions[]) {
  (void)valueReferences;
  (void)counters;
  (void)resolutions;
  return no_variables(instance, "fmi3SetIntervalFraction", nValueReferences);
}

FMI3_API fmi3Status fmi3SetShiftDecimal(fmi3Instance instance,
                                        const fmi3ValueReference valueReferences[],
                                        size_t nValueReferences, const fmi3Float64 shifts[]) {
  (void)valueReferences;
  (void)shifts;
  return no_variables(instance, "fmi3SetShiftDecimal", nValueReferences);
}

FMI3_API fmi3Status fmi3SetShiftFraction(fmi3Instance instance,
                                         const fmi3ValueReference valueReferences[],
                                         size_t nValueReferences, const fmi3UInt64 counters[],
                                         const fmi3UInt64 resolutions[]) {
  (void)valueReferences;
  (void)counters;
  (void)resolutions;
  return no_variables(instance, "fmi3SetShiftFraction", nValueReferences);
}

FMI3_API fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
  return unsupported(instance, "fmi3EnterStepMode");
}

FMI3_API fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance,
                                             const fmi3ValueReference valueReferences[],
                                             size_t nValueReferences, const fmi3Int32 orders[],
                                             fmi3Float64 values[], size_t nValues) {
  (void)valueReferences;
  (void)nValueReferences;
  (void)orders;
  (void)values;
  (void)nValues;
  return unsupported(instance, "fmi3GetOutputDerivatives");
}

FMI3_API fmi3Status fmi3ActivateModelPartition(fmi3Instance instance,
                                               fmi3ValueReference clockReference,
                                               fmi3Float64 activationTime) {
  (void)clockReference;
  (void)activationTime;
  return unsupported(instance, "fmi3ActivateModelPartition");
}

#endif
