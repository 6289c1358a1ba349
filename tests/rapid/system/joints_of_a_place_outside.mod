! RAPID Functions, CalcJointT: a target out of reach stops a program that does not handle the error.
MODULE joints_of_a_place_outside
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR jointtarget j;
    MoveJ p1,v500,fine,tool0;
    j:=CalcJointT(Offs(p1,5000,0,0),tool0);
    ! stops: `the target` cannot be reached by ABB IRB 1600-6/1.2: wrist centre 4477.9 mm beyond reach: the stretched arm puts it 1075.0 mm from axis 2, the target asks for 5552.9 mm
  ENDPROC
ENDMODULE
