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

// The bool of NumPy is none of Python, and item() makes it one. Numbers are no bool.
%fragment("MedialVoxelAsBool", "header", fragment=SWIG_AsVal_frag(bool))
{
SWIGINTERN int
MedialVoxelAsBool(PyObject * object, bool * value)
{
  PyObject * const item = PyObject_HasAttrString(object, "item") ? PyObject_CallMethod(object, "item", NULL) : NULL;
  if (item == NULL)
  {
    PyErr_Clear();
    return SWIG_AsVal(bool)(object, value);
  }
  const int result = SWIG_AsVal(bool)(item, value);
  Py_DECREF(item);
  return result;
}
}

%typemap(in, fragment="MedialVoxelAsBool", noblock=1) bool (bool val, int ecode = 0)
{
  ecode = MedialVoxelAsBool($input, &val);
  if (!SWIG_IsOK(ecode))
  {
    %argument_fail(ecode, "$type", $symname, $argnum);
  }
  $1 = val;
}
