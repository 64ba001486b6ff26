void damper_reset(damper_model* model, const damper_input* input) {
  DamperInput still;
  still.displacement = input->displacement;
  still.velocity = 0;
  still.current = input->current;
  inverse_rest(&still, model->state);
}

void damper_init(damper_model* model) {
  damper_input still = {0.0, 0.0, 0.0, 0.0, 0.0};
  still.current = inverse_least(&kInverse);
  damper_reset(model, &still);
}

double damper_step(damper_model* model, const damper_input* input) {
  return inverse_command(&kInverse, input, model->state);
}
