/* The functions of base/ranks_plugin.h by MPI: all that Dashpot uses of it. */
#include <mpi.h>
#include <stddef.h>

#include "dashpot/base/ranks_plugin.h"

static int join(int* number, int* count, int* here) {
  int provided = 0;
  MPI_Comm machine;
  MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, number);
  MPI_Comm_size(MPI_COMM_WORLD, count);
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, *number, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, here);
  MPI_Comm_free(&machine);
  return provided < MPI_THREAD_SERIALIZED;
}

static void send_bytes(int to, int tag, const void* bytes, int size) {
  MPI_Send(bytes, size, MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

static int arrived(int* from, int* tag, int* size) {
  MPI_Status status;
  int there = 0;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (!there) return 0;
  *from = status.MPI_SOURCE;
  *tag = status.MPI_TAG;
  MPI_Get_count(&status, MPI_BYTE, size);
  return 1;
}

static void receive(int from, int tag, void* bytes, int size) {
  MPI_Recv(bytes, size, MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

static void leave(void) { MPI_Finalize(); }

static void end(int code) { MPI_Abort(MPI_COMM_WORLD, code); }

__attribute__((visibility("default"))) const struct dashpot_mpi_functions* dashpot_mpi(void) {
  static const struct dashpot_mpi_functions functions = {join,    send_bytes, arrived,
                                                         receive, leave,      end};
  return &functions;
}
