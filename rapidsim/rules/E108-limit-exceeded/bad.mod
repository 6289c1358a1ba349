MODULE example
  VAR num a_name_with_far_too_many_letters_in_it; ! found
ENDMODULE
