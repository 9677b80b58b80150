/*
 * ode_predictive_space: record what a program tells a space, and what it asks it.
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
 * For programs that are linked with the library; others run under `ode-predictive run --record FILE`.
 * `ode-predictive replay FILE` reads the file: docs/recording.md.
 *
 * @{
 */

/**
 * Record from now on each dSpaceCollide() and dSpaceCollide2() of a space: before it, what has changed of the space's geoms
 * and of their bodies, to the bit, and after it, how many pairs there were. Not recorded: questions to nested spaces, and what
 * callbacks change during a collide. A space that is not recorded takes not one instruction more for it.
 *
 * The file is written before each collide. When the program crashes, it ends with the collide that the program did not survive.
 * When memory runs out, the recording is cut after its last whole record, and the program goes on without it.
 *
 * A recording of the space that is going on ends with this call in any case, also when the new file cannot be made: the space is
 * then not recorded.
 *
 * @param space a predictive space. When it is destroyed, its recording ends.
 * @param path a file, which is emptied if it exists, but refused while another recording is being written to it.
 *        0: end the recording, if there is one.
 * @param limit bytes; with the collide that would exceed it, the recording ends. 0: 256 MiB (268435456).
 * @return 1 when the file could be made; when the recording ends, 1 when all of it is in the file. Otherwise 0, after a message.
 *         A recording that could not be written to its end has whole records up to there, and a replay says where it is cut.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceRecord(dSpaceID space, const char *path, unsigned long limit);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
