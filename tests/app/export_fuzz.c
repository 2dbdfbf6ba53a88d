/* Random inputs into an exported controller: numbers, jumps, values that are none, encoder wraps
 * and changes of mode. Every output must be a number and the valve command within its limit.
 *
 * usage: export_fuzz STEPS SEED
 */
#include "servo_controller.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static uint64_t word;

/* xorshift64* of S. Vigna, 2016. */
static uint64_t random_word(void)
{
  word ^= word >> 12;
  word ^= word << 25;
  word ^= word >> 27;
  return word * UINT64_C(2685821657736338717);
}

static double uniform(double low, double high)
{
  return low + (high - low) * (double)(random_word() >> 11) / 9007199254740992.0;
}

/* Around `size` mostly; now and then huge, tiny or no number. */
static double any_number(double size)
{
  switch (random_word() % 64) {
    case 0: return NAN;
    case 1: return INFINITY;
    case 2: return -INFINITY;
    case 3: return 1e300 * uniform(-1.0, 1.0);
    case 4: return 1e-310;
    case 5: return 10.0 * size * uniform(-1.0, 1.0);
    default: return size * uniform(-1.0, 1.0);
  }
}

static servo_real any_real(double size)
{
  const double value = any_number(size);
  /* A double beyond float would not convert. */
  return sizeof(servo_real) == sizeof(float) && isfinite(value) && fabs(value) > 3e38
             ? (servo_real)copysign(3e38, value)
             : (servo_real)value;
}

int main(int argument_count, char **arguments)
{
  const servo_parameters *parameters = &servo_default_parameters;
  const double limit = (double)parameters->command_limit * (double)parameters->valve_scale;
  servo_state state;
  const uint64_t turn = (uint64_t)servo_default_parameters.counts_per_turn;
  uint64_t counts = 0;
  servo_inputs inputs = {0};
  servo_outputs outputs;
  long faults = 0;
  long limited = 0;
  long steps;
  if (argument_count != 3) return 2;
  steps = strtol(arguments[1], NULL, 10);
  word = strtoull(arguments[2], NULL, 10) * 2 + 1;
  servo_initialise(&state);
  for (long k = 0; k < steps; ++k) {
    inputs.run = random_word() % 50 != 0;
    inputs.target_angle = any_number(400.0);
    inputs.target_rate = any_number(0.3);
    inputs.manual_command = any_real(2.0 * limit);
    if (random_word() % 256 == 0) {
      inputs.encoder_counts = (int32_t)(uint32_t)random_word();
    } else {
      /* A walk of some tens of counts, through the wrap too. */
      counts = (counts + random_word() % 101 + turn - 50) % turn;
      inputs.encoder_counts = (int32_t)counts;
    }
    inputs.tachometer = any_real(0.9 * (double)parameters->largest_tachometer);
#ifdef READS_TORQUE
    inputs.pressure_difference = any_real(0.9 * (double)parameters->largest_pressure_difference);
#endif
    servo_step(parameters, &state, &inputs, &outputs);
    if (!(fabs((double)outputs.valve_command) <= limit * (1.0 + 1e-6)) ||
        !isfinite(outputs.encoder_error) || !isfinite(outputs.reference) ||
        !isfinite(outputs.reference_rate) || !isfinite(outputs.position) || outputs.fault < 0 || outputs.fault > 1) {
      printf("step %ld: valve command %g, fault %d, encoder error %g, reference %g\n", k,
             (double)outputs.valve_command, (int)outputs.fault, outputs.encoder_error,
             outputs.reference);
      return 1;
    }
    if (outputs.fault != 0 && outputs.valve_command != (servo_real)0.0) return 1;
    faults += outputs.fault != 0;
    limited += fabs((double)outputs.valve_command) >= limit * (1.0 - 1e-6);
  }
  printf("%ld steps, %ld faults, %ld at the limit\n", steps, faults, limited);
  return faults > 0 && limited > 0 && faults < steps ? 0 : 1;
}
