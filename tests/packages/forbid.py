#!/usr/bin/env python3
"""Runs a command on a kernel that refuses seccomp and Landlock with EPERM: forbid.py COMMAND...

As some container platforms do, by a filter that the command inherits (seccomp(2), x86-64)."""
import ctypes
import os
import struct
import sys

LOAD, JUMP_EQUAL, RETURN = 0x20, 0x15, 0x06  # linux/bpf_common.h: LD|W|ABS, JMP|JEQ|K, RET|K
ALLOW, REFUSE = 0x7FFF0000, 0x00050001       # linux/seccomp.h: RET_ALLOW, RET_ERRNO | EPERM
PR_SET_SECCOMP, PR_SET_NO_NEW_PRIVS = 22, 38
SECCOMP, PRCTL, LANDLOCK = 317, 157, (444, 445, 446)

steps = [(LOAD, 0, 0, 0)]  # the number of the call
for number in (SECCOMP, *LANDLOCK):
    steps += [(JUMP_EQUAL, 0, 1, number), (RETURN, 0, 0, REFUSE)]
steps += [(JUMP_EQUAL, 0, 3, PRCTL), (LOAD, 0, 0, 16), (JUMP_EQUAL, 0, 1, PR_SET_SECCOMP),
          (RETURN, 0, 0, REFUSE), (RETURN, 0, 0, ALLOW)]
code = ctypes.create_string_buffer(b"".join(struct.pack("HBBI", *step) for step in steps))
program = struct.pack("HxxxxxxP", len(steps), ctypes.addressof(code))
libc = ctypes.CDLL(None, use_errno=True)
if libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) or libc.prctl(PR_SET_SECCOMP, 2, program, 0, 0):
    sys.exit(os.strerror(ctypes.get_errno()))
os.execvp(sys.argv[1], sys.argv[1:])
