// Every style of ours, in LIGGGHTS's own way: included with FIX_CLASS, COMPUTE_CLASS or COMMAND_CLASS
// defined, each header expands to its FixStyle(...), ComputeStyle(...) or CommandStyle(...) line.
#include "command_dem_timestep.h"
#include "command_report.h"
#include "fix_contact_sampler.h"
#include "fix_stress_servo.h"
