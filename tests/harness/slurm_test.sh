#!/usr/bin/env bash
# A sweep as a job array of a real Slurm with one node (Debian's slurm-wlm and munge), which this starts and ends; skipped
# (77) where it is not installed, or not root's to start.
#   slurm_test.sh PROGRAM SOURCE_DIR
set -u
vlbeam=$1
source=$2
for needed in slurmctld slurmd sbatch munge; do
  command -v $needed > /dev/null || { echo "skipped: $needed is not installed"; exit 77; }
done
[[ $(id -u) -eq 0 ]] || { echo "skipped: only root may start slurmd"; exit 77; }
folder=$(mktemp -d)
cleanup() {
  for daemon in slurmd slurmctld munged; do
    [[ -s $folder/$daemon.pid ]] && kill "$(cat "$folder/$daemon.pid")" 2> /dev/null
  done
  sleep 1
  rm -rf "$folder"
}
trap cleanup EXIT
cd "$folder" || exit 1
if ! munge -n 2> /dev/null | unmunge > /dev/null 2>&1; then
  chmod 755 "$folder"
  mkdir -p /run/munge && chown munge /run/munge
  runuser -u munge -- munged || { echo "skipped: munged does not start"; exit 77; }
  pgrep -n munged > munged.pid
fi
host=$(hostname -s)
cat > slurm.conf << CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=26817
SlurmdPort=26818
AuthType=auth/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MpiDefault=none
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
mkdir state spool
export SLURM_CONF=$folder/slurm.conf
slurmctld -c && slurmd || { echo "skipped: slurm does not start here"; exit 77; }

"$vlbeam" scene pendulum > pendulum.json
cat > sweep.json << 'SWEEP'
{"schema": "vlbeam.sweep/1", "scene": "pendulum.json", "quantities": ["end.y"],
 "over": {"/beam/elements": [4, 6, 8], "/integrator/rtol /integrator/atol": [1e-9, 1e-8, 1e-7, 1e-6]}}
SWEEP
sbatch --wait --array=0-11 "$source/scripts/slurm_sweep.sh" "$vlbeam" sweep.json out || { echo "FAILED: the job array"; exit 1; }
"$vlbeam" sweep sweep.json --out out --collect || { echo "FAILED: joining its cases"; exit 1; }
"$vlbeam" sweep sweep.json --out here || { echo "FAILED: the sweep"; exit 1; }
for file in sweep.csv sweep.json; do cmp out/$file here/$file || { echo "FAILED: $file has other bits"; exit 1; }; done
echo "all checks passed"
