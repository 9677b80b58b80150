"""The pairs that a program got for its collides, compared with a replay of them."""
import re
import subprocess


def compared(tool, recording):
    """Replays a recording in simple spaces, which check all pairs, and in predictive ones.

    Returns the number of events, of those in which the program got other pairs than simple spaces find, and the output.
    Raises RuntimeError if predictive spaces find other pairs than simple ones in the replay, or if there is no recording.
    """
    done = subprocess.run([tool, "replay", "--pairs", "--space", "box", recording], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"replayed with status {done.returncode}: {done.stdout[-2000:]}{done.stderr[-500:]}")
    same = re.search(r"The program got the pairs of simple spaces in all of its (\d+) events", done.stdout)
    if same:
        return int(same[1]), 0, done.stdout
    other = re.search(r"The program got other pairs than simple spaces give here in (\d+) of (\d+) events", done.stdout)
    return (int(other[2]), int(other[1]), done.stdout) if other else (0, 0, done.stdout)
