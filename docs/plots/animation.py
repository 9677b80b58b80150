#!/usr/bin/env python3
"""Makes the animation of the demo: docs/pictures/haptic_demo.gif.

    animation.py [--demo PROGRAM] [--output FILE] [--frames N]

Needs Xvfb and Pillow. Each frame is a picture of one run of the demo, taken at its own simulated time; the runs have the same
seed, so they show the same scene. The time is one at which the probe is in contact.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

from PIL import Image

SCENE = ["--scene", "mix", "--objects", "200", "--seed", "2", "--fast", "--device", "virtual"]
BEGIN, END = 2.12, 2.48  # simulated s; the hand feels a force all the while
WIDTH, FRAME_MS = 640, 100
COLOURS, VIVID_COLOURS = 256, 80
LEAST_VIVID = 75  # of 255: between the largest and the smallest of red, green and blue
LARGEST = 1_000_000  # bytes


def parse(arguments):
    parser = argparse.ArgumentParser(description="Makes the animation of the demo.")
    parser.add_argument("--demo", default="build/release/demos/predictive_haptic_demo")
    parser.add_argument("--output", default="docs/pictures/haptic_demo.gif")
    parser.add_argument("--frames", type=int, default=16)
    options = parser.parse_args(arguments)
    if options.frames < 2:
        parser.error("--frames must be at least 2")
    if not os.access(options.demo, os.X_OK):
        parser.error(f"there is no demo at {options.demo}: ./run build builds it")
    return options


def open_display():
    """Starts Xvfb on a free display. Returns the process and the display's name."""
    reading, writing = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1024x768x24"], pass_fds=[writing],
                              stderr=subprocess.DEVNULL)
    os.close(writing)
    with os.fdopen(reading) as lines:
        return server, ":" + lines.readline().strip()


def take_frame(demo, display, time, file):
    subprocess.run([demo, *SCENE, "--screenshot", file, "--at", f"{time:.3f}"], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "DISPLAY": display})
    picture = Image.open(file).convert("RGB")
    return picture.resize((WIDTH, picture.height * WIDTH // picture.width), Image.LANCZOS)


def colours_of(pixels, number):
    strip = Image.new("RGB", (len(pixels), 1))
    strip.putdata(pixels)
    return strip.quantize(number, Image.Quantize.MEDIANCUT).getpalette()[:3 * number]


def with_common_colours(pictures):
    """In the colours of all pictures together. Vivid ones, as that of the probe, cover little: some are kept for them."""
    pixels = [pixel for picture in pictures for pixel in picture.getdata()]
    vivid = [pixel for pixel in pixels if max(pixel) - min(pixel) > LEAST_VIVID]
    palette = Image.new("P", (1, 1))
    palette.putpalette(colours_of(pixels, COLOURS - VIVID_COLOURS) + colours_of(vivid, VIVID_COLOURS))
    return [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures]


def main():
    options = parse(sys.argv[1:])
    server, display = open_display()
    try:
        with tempfile.TemporaryDirectory() as folder:
            times = [BEGIN + (END - BEGIN) * i / (options.frames - 1) for i in range(options.frames)]
            frames = with_common_colours(
                [take_frame(options.demo, display, time, f"{folder}/frame.png") for time in times])
    finally:
        server.terminate()
        server.wait()
    frames[0].save(options.output, save_all=True, append_images=frames[1:], duration=FRAME_MS, loop=0, optimize=True)
    size = pathlib.Path(options.output).stat().st_size
    print(f"{options.output}: {size} bytes")
    if size > LARGEST:
        sys.exit(f"animation.py: more than {LARGEST} bytes")


if __name__ == "__main__":
    main()
