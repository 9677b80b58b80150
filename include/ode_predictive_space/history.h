/*
 * ode_predictive_space: record the changes of a space's geoms, and its collides and queries.
 *
 * Copyright (c) the ode_predictive_space developers. BSD-3-Clause, see LICENSE.
 */

#ifndef ODE_PREDICTIVE_SPACE_HISTORY_H
#define ODE_PREDICTIVE_SPACE_HISTORY_H

#include <ode_predictive_space/predictive_space.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup predictive_space_history A recorded history
 * @ingroup predictive_space
 *
 * This is for programs that are linked with the library; others run under `ode-predictive run --record FILE`. The file is
 * replayed by `ode-predictive replay FILE`: docs/recording.md.
 *
 * @{
 */

/**
 * Record each dSpaceCollide() and dSpaceCollide2() of a space from now on: before it, the changes of the space's geoms and of
 * their bodies, to the bit, and after it, the number of pairs. Queries to nested spaces, nested spaces as probes, and changes
 * by callbacks during a collide are not recorded. A space that is not recorded runs no further instruction.
 *
 * The file is written before each collide. If the program crashes, it ends with the collide in which the program crashed.
 * If memory runs out, the recording is cut after its last whole record, and the program continues without it.
 *
 * This call always ends the present recording of the space, even if the new file cannot be made; the space is then not
 * recorded.
 *
 * No other thread may use the space during this call. A call in a callback of the space is an assertion of ODE (dDebug()).
 *
 * @param space a predictive space. Its destruction ends the recording.
 * @param path a file, which is emptied if it exists, but refused while another recording is being written to it. The text is
 *        not kept. 0 ends the recording, if one exists.
 * @param limit size of the file in bytes; the collide that would exceed it ends the recording. 0 means 256 MiB (268435456).
 * @return with a path, 1 when the file could be made; with 0, 1 when the whole recording is in the file or none existed.
 *         Otherwise 0, after a message of ODE. A recording that could not be written to its end has whole records up to there,
 *         and a replay says where it is cut.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceRecord(dSpaceID space, const char *path, unsigned long limit);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
