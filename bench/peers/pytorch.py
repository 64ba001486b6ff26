"""PyTorch, eager, Adam in its quicker (foreach) form."""
import sys
import time

import torch

torch.set_num_threads(1)
torch.set_flush_denormal(True)
nn = torch.nn
net = nn.Sequential(nn.Linear(8, 15), nn.ReLU(), nn.Linear(15, 15), nn.ReLU(), nn.Linear(15, 15), nn.ReLU(),
                    nn.Linear(15, 1))
adam = torch.optim.Adam(net.parameters(), lr=1e-3, foreach=True)
inputs, targets = torch.rand(2000, 8), torch.rand(2000, 1)


def training():
    start = time.thread_time()
    for first in range(0, 2000, 20):
        adam.zero_grad()
        nn.functional.mse_loss(net(inputs[first:first + 20]), targets[first:first + 20]).backward()
        adam.step()
    return (time.thread_time() - start) / 2000


print("training", flush=True)
for _ in sys.stdin:
    print(training(), flush=True)
