"""The writes of `batch` and its steps are recorded once and replayed up to random moments, as two kinds of disks keep them."""
import shutil

import write_log
from batch_faults import Batch
from campaign import Answer


def certain_marks(operations):
    """The scans whose mark of being done has its name, and the folder of it was synced afterwards."""
    renamed, certain = set(), set()
    for operation in operations:
        if operation[0] == "rename" and operation[2].endswith(b"/done.json"):
            renamed.add(write_log.parent(operation[2]))
        elif operation[0] == "sync":
            certain |= renamed & {operation[1]}
    return {name.decode() for name in certain}


def run(campaign):
    answer = Answer(
        "batch_cuts",
        "power cut at random writes of `batch` of two scans (ordered and reordered disks), then finished",
        campaign.count(4, 300),
    )
    if not shutil.which("strace"):
        raise SystemExit("faults: batch_cuts needs strace; install it")
    batch = Batch(campaign, answer)
    log = batch.folder / "writes"
    if write_log.record(batch.command("recorded"), log, batch.folder) != 0:
        answer.failures.append("the recorded batch failed")
        return answer
    operations = list(write_log.operations(log, batch.folder / "recorded"))
    if certain_marks(operations) != set(batch.names):
        answer.failures.append(f"done and synced are {certain_marks(operations)}, not all scans")
    answer.measured = f"{len(operations)} operations recorded"
    progress = campaign.progress(answer)
    for i in progress.rest():
        chance = progress.chance(i)
        cut = chance.randint(1, len(operations))
        model = ("ordered", "reordered")[i % 2]
        disk = write_log.Disk()
        for operation in operations[:cut]:
            disk.apply(operation)
        out = f"cut-{i}"
        disk.write_to(batch.folder / out, chance if model == "reordered" else None)
        what = f"cut after operation {cut} ({' '.join(map(str, operations[cut - 1][:2]))}), {model}"
        for name in certain_marks(operations[:cut]) - set(batch.digests(out)):
            answer.failures.append(f"{what}: {name} was done, and no longer is")
        batch.finish(out, what)
    return answer
