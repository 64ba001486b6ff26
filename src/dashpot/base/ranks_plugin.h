#pragma once

/* What the program knows of MPI: a few C functions in a library of its own, dashpot-mpi.so, which
   is loaded under mpirun alone. So the program itself neither links nor needs MPI. Calls come from
   one thread at a time; a fault within MPI ends the job, as MPI does. */

#ifdef __cplusplus
extern "C" {
#endif

struct dashpot_mpi_functions {
  /* Enters the job. number: of this process, from 0 on; count: of all; here: those on this machine.
   */
  /* Returns 0, or 1 where this MPI does not allow several threads to take turns. */
  int (*join)(int* number, int* count, int* here);
  /* Gives bytes to a process; returns when they may be changed. */
  void (*send)(int to, int tag, const void* bytes, int size);
  /* Whether a message waits; if so, whose, of which tag and how long. Does not wait. */
  int (*arrived)(int* from, int* tag, int* size);
  /* Takes that message. */
  void (*receive)(int from, int tag, void* bytes, int size);
  /* Leaves the job in order, together with all others. */
  void (*leave)(void);
  /* Ends all processes of the job, this one with that exit code. */
  void (*end)(int code);
};

/* The one function that the library shows, by its name. */
#define DASHPOT_MPI_ENTRY "dashpot_mpi"
typedef const struct dashpot_mpi_functions* (*dashpot_mpi_entry)(void);

#ifdef __cplusplus
}
#endif
