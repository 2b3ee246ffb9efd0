#pragma once

/// A vector kernel's functions are defined in the namespace of each instruction set that they are compiled
/// for; its header, which the kernel includes too, declares them all:
///
///   #define SUFFUSE_DECLARE(instruction_set) namespace instruction_set { void add(double* values); }
///   SUFFUSE_FOR_EACH_INSTRUCTION_SET(SUFFUSE_DECLARE)
///   #undef SUFFUSE_DECLARE
#define SUFFUSE_FOR_EACH_INSTRUCTION_SET(declare) declare(portable) declare(avx2) declare(avx512)
