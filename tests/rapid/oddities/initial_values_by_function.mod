! Field practice, Initial values: a function is no constant expression.
MODULE initial_values_by_function
  CONST robtarget p10:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget above:=Offs(p10,0,0,50);  ! error: T311
  CONST speeddata slow:=v100;
ENDMODULE
