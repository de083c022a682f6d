// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef AccuracyTables_h
#define AccuracyTables_h

// What doc/explanation/accuracy.md shows parts of, as tables of Markdown.

/** Errors of the thickness of tilted plates, by thickness. */
void
PrintThicknessTable();

/** The same on gray values, by blur and thickness, and beside a gap. */
void
PrintGrayThicknessTable();

/** Distance from the true mid-surface, angles and sides of the mesh of binary objects. */
void
PrintSurfaceTable();

/** The sheets of all parts, with automatic and with fixed thickness. */
void
PrintAutomaticTable();

/** The sheets of single walls: those that are not covered everywhere. */
void
PrintAutomaticWallsTable();

/** Cells that pores cause, by the size of pores that are left out: mean and worst of five volumes. */
void
PrintAutomaticPoresTable();

/** How much farther in than the medial axis of a square rim the sheet begins. */
void
PrintAutomaticRimsTable();

#endif // AccuracyTables_h
