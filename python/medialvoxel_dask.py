# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs a job that `medialvoxel plan` prepared on the workers of a Dask cluster.

Each task is the command `medialvoxel work JOBDIR --clusters I-J`: workers need the program and the folder of the job, but
not this file. Dask starts the tasks of a lost worker again; finished clusters are skipped.

    from distributed import Client
    import medialvoxel_dask

    counts = medialvoxel_dask.run_job(Client("scheduler:8786"), "/shared/job", threads=4, memory="8G")

or, in a terminal: python3 medialvoxel_dask.py /shared/job --scheduler scheduler:8786 --threads 4 --memory 8G
"""

import argparse
import collections
import json
import os
import re
import subprocess

from distributed import Client, as_completed

MOST_TASKS = 64

Counts = collections.namedtuple("Counts", "executed skipped")
Counts.__doc__ = """Numbers of clusters, each 0 or more: executed by the tasks, and skipped because they were done before.

If a worker is lost, the task that takes over reports the clusters that were done as skipped."""


class JobError(RuntimeError):
    """A command of the job failed on a worker; the message is the command's own."""


def run_job(client, job, **options):
    """Computes all clusters of a job, then finalizes it. Returns Counts.

    client: a distributed.Client. job: the folder that `medialvoxel plan` made, at the same place on all workers.
    options: keyword arguments of work().

    Call it again after an error or an interruption to continue. Raises JobError, as work() and finalize()."""
    counts = work(client, job, **options)
    finalize(client, job, options.get("program", "medialvoxel"))
    return counts


def work(client, job, clusters_per_task=None, threads=1, memory=None, program="medialvoxel", retries=2):
    """Computes the clusters of a job that are missing. Returns Counts.

    clusters_per_task: 1 or more; None (default): the smallest number that gives at most 64 tasks.
    threads: threads of a task, 1 or more (default 1). Workers with `--nthreads 1` run one task at a time.
    memory: limit of a task, such as "8G"; None (default): half of the free memory of its machine at the start.
    program: name or path of medialvoxel on the workers.
    retries: how often a failing task is tried again, 0 or more (default 2).

    Raises JobError when a command still fails, ValueError for clusters_per_task below 1. On an error or an interruption,
    waiting tasks are cancelled; running commands finish, and their clusters count as done."""
    options = ["--threads", str(threads), "--progress", "none"]
    options += ["--memory", str(memory)] if memory else []
    clusters = json.loads(_run(client, [program, "status", _place(job), "--json"]))["clusters"]
    futures = [
        _submit(client, [program, "work", _place(job), "--clusters", clusters_of_task, *options], retries)
        for clusters_of_task in split(clusters, clusters_per_task)
    ]
    try:
        executed = skipped = 0
        for future in as_completed(futures):
            text = _output(future)
            # Or Dask would do it again when the worker that holds the result is lost.
            future.release()
            executed += _count(text, "done")
            skipped += _count(text, "skipped")
        return Counts(executed, skipped)
    except BaseException:
        client.cancel(futures)
        raise


def finalize(client, job, program="medialvoxel"):
    """Verifies the job and renames its outputs, on one worker. Returns the text that the command printed.

    Raises JobError when clusters are missing or damaged."""
    return _run(client, [program, "finalize", _place(job), "--progress", "none"])


def split(clusters, clusters_per_task=None):
    """Splits a number of clusters into consecutive ranges for --clusters: split(10, 4) is ["0-3", "4-7", "8-9"].

    Raises ValueError for clusters_per_task below 1."""
    size = -(-clusters // MOST_TASKS) if clusters_per_task is None else clusters_per_task
    if size < 1:
        raise ValueError(f"clusters_per_task is {clusters_per_task}; it must be 1 or more")
    return [f"{first}-{min(first + size, clusters) - 1}" for first in range(0, clusters, size)]


def _place(job):
    """Workers have other current folders."""
    return os.path.abspath(job)


def _submit(client, command, retries=0):
    return client.submit(
        subprocess.run, command, check=True, capture_output=True, text=True, stdin=subprocess.DEVNULL,
        pure=False, retries=retries,
    )  # fmt: skip


def _output(future):
    try:
        return future.result().stdout
    except subprocess.CalledProcessError as error:
        raise JobError(error.stderr.strip() or str(error)) from error


def _run(client, command):
    return _output(_submit(client, command))


def _count(text, kind):
    return int(re.search(rf"^clusters {kind} +(\d+)$", text, re.MULTILINE)[1])


def main():
    parser = argparse.ArgumentParser(description="Does a job of medialvoxel plan on a Dask cluster.")
    parser.add_argument("job", metavar="JOBDIR", help="folder of the job, the same on all workers")
    parser.add_argument("--scheduler", required=True, metavar="ADDRESS", help="of the Dask cluster, such as host:8786")
    parser.add_argument("--clusters-per-task", type=int, metavar="N", help="default: as few as give at most 64 tasks")
    parser.add_argument("--threads", type=int, default=1, metavar="N", help="of a task, default 1")
    parser.add_argument("--memory", metavar="SIZE", help="most memory of a task, such as 8G")
    parser.add_argument("--program", default="medialvoxel", help="the program on the workers")
    arguments = vars(parser.parse_args())
    with Client(arguments.pop("scheduler")) as client:
        try:
            counts = run_job(client, **arguments)
        except JobError as error:
            parser.exit(1, f"{error}\n")
    print(f"clusters executed  {counts.executed}\nclusters skipped   {counts.skipped}")


if __name__ == "__main__":
    main()
