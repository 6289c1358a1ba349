MODULE example
ENDMODULE
Remember to teach the home position! ! found
