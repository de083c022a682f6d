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

// Members of structures, which the generator of ITK leaves out. Python reads them.
%define MEDIALVOXEL_MEMBER(structure, type, name, expression)
%immutable structure::name;
%extend structure { type name; }
%{
#define structure##_##name##_get(self) (expression)
%}
%enddef

%define MEDIALVOXEL_COUNT(name)
MEDIALVOXEL_MEMBER(itkMedialVoxelCounts, unsigned long long, name, (self)->name)
%enddef

MEDIALVOXEL_COUNT(objectVoxels)
MEDIALVOXEL_COUNT(boundaryVoxels)
MEDIALVOXEL_COUNT(notANumberVoxels)
MEDIALVOXEL_COUNT(filledVoxels)
MEDIALVOXEL_COUNT(removedVoxels)
MEDIALVOXEL_COUNT(candidateCells)
MEDIALVOXEL_COUNT(trivialCells)
MEDIALVOXEL_COUNT(boundCells)
MEDIALVOXEL_COUNT(geodesicMedialCells)
MEDIALVOXEL_COUNT(geodesicNonMedialCells)

// 0 without a scan.
%define MEDIALVOXEL_SCAN(name)
MEDIALVOXEL_MEMBER(itkMedialVoxelScanResult, double, name, (self)->scan ? (self)->scan->name : 0.0)
%enddef

MEDIALVOXEL_SCAN(background)
MEDIALVOXEL_SCAN(material)
MEDIALVOXEL_SCAN(blur)
MEDIALVOXEL_SCAN(noise)
MEDIALVOXEL_MEMBER(itkMedialVoxelScanResult, std::string, reason, (self)->reason)
MEDIALVOXEL_MEMBER(itkMedialVoxelScanResult, bool, isMask, (self)->isMask)
