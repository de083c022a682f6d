// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Enumerations of ITK have 8 bits: a number that does not fit into them is an OverflowError, not another enumerator. The
// setters refuse those that fit and are none.
%typemap(in, fragment=SWIG_AsVal_frag(unsigned char), noblock=1) enum SWIGTYPE (unsigned char val, int ecode = 0)
{
  ecode = SWIG_AsVal(unsigned char)($input, &val);
  if (!SWIG_IsOK(ecode))
  {
    %argument_fail(ecode, "$type", $symname, $argnum);
  }
  $1 = %static_cast(val, $1_ltype);
}
