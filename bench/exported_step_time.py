"""Measures the time of a step of exported C code, beside the sample time that it runs in.

usage: exported_step_time.py PROGRAM CASE [OPTIONS]

OPTIONS are those of `boresight export`, such as --gains FILE or --controller FILE. Prints
nanoseconds per step and operations per step in double and single precision.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

LOOP = """#define _POSIX_C_SOURCE 199309L
#include "servo_controller.h"
#include <stdio.h>
#include <time.h>
int main(void)
{
  enum { steps = 2000000 };
  servo_state state;
  servo_inputs inputs = {0};
  servo_outputs outputs;
  struct timespec start, end;
  double sum = 0.0;
  servo_initialise(&state);
  inputs.run = true;
  inputs.target_rate = 0.004;
  clock_gettime(CLOCK_MONOTONIC, &start);
  for (int k = 0; k < steps; ++k) {
    inputs.target_angle = 180.0 + 8e-5 * k;
    inputs.encoder_counts = (int32_t)(servo_default_parameters.counts_per_turn / 2 + k % 1000);
    servo_step(&servo_default_parameters, &state, &inputs, &outputs);
    sum += (double)outputs.valve_command;
  }
  clock_gettime(CLOCK_MONOTONIC, &end);
  printf("%.1f %g\\n", (1e9 * (double)(end.tv_sec - start.tv_sec) +
                       (double)(end.tv_nsec - start.tv_nsec)) / steps, sum);
  return 0;
}
"""


def main(program, case, options):
    for precision in ["double", "single"]:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([program, "export", case, "--folder", folder, "--precision", precision,
                            "--language", "c", "json", "--quiet", *options], check=True)
            (pathlib.Path(folder) / "loop.c").write_text(LOOP, encoding="utf-8")
            subprocess.run(["cc", "-std=c99", "-O2", "-ffp-contract=off", "-o", "loop", "loop.c",
                            "servo_controller.c", "-lm"], cwd=folder, check=True)
            times = [float(subprocess.run(["./loop"], cwd=folder, check=True, capture_output=True,
                                          text=True).stdout.split()[0]) for _ in range(5)]
            written = json.loads((pathlib.Path(folder) / "servo_controller.json").read_text())
            print(f"{written['structure']}, {precision}: {min(times):.0f} ns per step, at most "
                  f"{written['operations_per_step']} floating-point operations, sample time "
                  f"{1e3 * written['sample_time_s']:g} ms")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
