"""PyTorch, eager, Adam in its quicker (foreach) form: pytorch.py PROGRAM, the peer of Dashpot."""
import sys
import time

import torch

from passive_twin import PassiveTwin

torch.set_num_threads(1)
torch.set_flush_denormal(True)
nn = torch.nn
net = nn.Sequential(nn.Linear(8, 15), nn.ReLU(), nn.Linear(15, 15), nn.ReLU(), nn.Linear(15, 15), nn.ReLU(),
                    nn.Linear(15, 1))
adam = torch.optim.Adam(net.parameters(), lr=1e-3, foreach=True)
inputs, targets = torch.rand(2000, 8), torch.rand(2000, 1)
twin = PassiveTwin(sys.argv[1])


def training():
    start = time.thread_time()
    for first in range(0, 2000, 20):
        adam.zero_grad()
        nn.functional.mse_loss(net(inputs[first:first + 20]), targets[first:first + 20]).backward()
        adam.step()
    return (time.thread_time() - start) / 2000


def passive_training():
    start = time.thread_time()
    twin.update()
    return time.thread_time() - start


tasks = {"training": training}
if twin.is_equal():
    tasks["passive_training"] = passive_training
else:
    print("the passive network of PyTorch is not that of Dashpot", file=sys.stderr)
print(*tasks, flush=True)
for line in sys.stdin:
    print(tasks[line.split()[0]](), flush=True)
