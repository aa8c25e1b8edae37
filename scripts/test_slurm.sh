#!/usr/bin/env bash
# A sweep through a real Slurm: two nodes on this host, in a folder of their own, as whoever runs it.
# Compares with the same sweep made by one process, also after a task was killed and put back.
# usage: scripts/test_slurm.sh [CAROM]
set -euo pipefail
cd "$(dirname "$0")/.."
carom=$(realpath "${1:-build/release/carom}")
for program in munged slurmctld slurmd sbatch; do
    command -v $program > /dev/null || { echo "skipped: $program is not here (packages munge slurm-wlm)"; exit 0; }
done

work=$(mktemp -d)
pids=()
stop() {
    for pid in "${pids[@]}"; do kill "$pid" 2> /dev/null || true; done
    wait 2> /dev/null || true
    rm -rf "$work"
}
trap stop EXIT

# A key and a socket of its own, so that nothing of the system's is touched.
mkdir -p "$work"/{munge,state,spool1,spool2}
chmod 700 "$work/munge"
dd if=/dev/urandom of="$work/munge/key" bs=1 count=1024 status=none
chmod 400 "$work/munge/key"
user=$(id -un) host=$(hostname -s)
munged --foreground --force --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" \
    --seed-file="$work/munge/seed" --log-file="$work/munge/log" > "$work/munged.log" 2>&1 &
pids+=($!)
cat > "$work/slurm.conf" <<CONF
ClusterName=carom
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CryptoType=crypto/munge
SlurmctldPort=36817
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/%n.spool
SlurmctldPidFile=$work/ctld.pid
SlurmdPidFile=$work/%n.pid
SlurmctldLogFile=$work/ctld.log
SlurmdLogFile=$work/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
MaxArraySize=4
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=36821 CPUs=1
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=36822 CPUs=1
PartitionName=main Nodes=n1,n2 Default=YES State=UP
CONF
export SLURM_CONF=$work/slurm.conf
sleep 1
slurmctld -D -c -f "$SLURM_CONF" > "$work/ctld.out.log" 2>&1 & pids+=($!)
slurmd -D -N n1 -f "$SLURM_CONF" > "$work/n1.out.log" 2>&1 & pids+=($!)
slurmd -D -N n2 -f "$SLURM_CONF" > "$work/n2.out.log" 2>&1 & pids+=($!)
for _ in $(seq 60); do
    [ "$(sinfo -h -t idle -o %D 2> /dev/null)" = 2 ] && break
    sleep 1
done
[ "$(sinfo -h -t idle -o %D)" = 2 ] || { tail -n 20 "$work"/*.log; echo "Slurm has not started"; exit 1; }

cat > "$work/base.yaml" <<'SCENE'
carom: 1
simulation: {duration: 1}
materials: {rubber: {restitution: 0.8}}
surfaces: [{name: floor, plane: {normal: [0, 0, 1], offset: 0}}]
balls: [{name: a, radius: 0.1, material: rubber, position: [0, 0, 1]}]
film: {size: [64, 64], fps: 30}
SCENE
cat > "$work/sweep.yaml" <<'SWEEP'
base: base.yaml
mode: random
count: 120
seed: 1
axes: {"balls.a.position[2]": {uniform: [0.5, 2]}}
results: {top: 'peak("a", 1)'}
outputs: {film: mp4, events: true}
SWEEP
"$carom" sweep "$work/sweep.yaml" -o "$work/right" -q
"$carom" sweep "$work/sweep.yaml" -o "$work/out" --slurm --tasks 6 --partition main

# The first task that runs is killed and put back, as where a node fails.
for _ in $(seq 60); do
    job=$(squeue -h -t R -o %A | head -n 1)
    [ -n "$job" ] && break
    sleep 0.5
done
scontrol requeue "$job"
for _ in $(seq 300); do
    [ -z "$(squeue -h)" ] && break
    sleep 1
done
[ -z "$(squeue -h)" ] || { squeue; echo "jobs are still there"; exit 1; }
diff -r --exclude=slurm "$work/right" "$work/out" || { cat "$work"/out/slurm/*.log; exit 1; }
echo "Slurm: 120 runs in 6 tasks of two arrays, one of them put back: equal to one process's"
